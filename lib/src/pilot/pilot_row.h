#pragma once

#include "pilot/candidate_moments.h"
#include "pilot/pilot_splats.h"

#include <vector>

namespace bdpt {

/// What the camera paths in the pixel of a cell found.
struct PilotCell {
    double mean = 0.0;         ///< of what they find well [nit]
    VarianceOfSamples direct;  ///< of paths of two edges
    VarianceOfSamples indirect;
};

/// A point of a lamp that is seen through the lens (s = t = 1).
struct PilotLamp {
    int x;  ///< of its pixel
    int y;
    std::size_t cell;
    double value;     ///< what it brings to the pixel, if this strategy were alone [nit]
    double radiance;  ///< of the lamp there [nit]
    double weight;    ///< of this strategy
    double mean;      ///< what it adds to the brightness of its cell [nit]
};

/// The cells of one row of a pilot's grid.
class PilotRow {
public:
    /// The fewest from which the square of a mean can be told.
    static constexpr int samples_of_cell = 2;

    /// Adds sample `index` of every cell. `integrator` connects each camera path to
    /// `PathShares::pilot_connections` of the light paths that it has traced, of which there are
    /// `light_paths` for each pixel of the image, and merges it with all.
    void render(const Integrator& integrator, const PilotGrid& grid, Heuristic heuristic, int row,
                std::int64_t index, double light_paths);

    [[nodiscard]] const std::vector<PilotCell>& cells() const { return cells_; }
    /// Paths of two edges and more.
    [[nodiscard]] const std::vector<PilotContribution>& joined() const { return joined_; }
    /// Paths that were found by merging.
    [[nodiscard]] const std::vector<PilotContribution>& merged() const { return merged_; }
    [[nodiscard]] const std::vector<PilotLamp>& lamps() const { return lamps_; }
    [[nodiscard]] const RenderStats& stats() const { return stats_; }

private:
    std::vector<PilotCell> cells_;
    std::vector<PilotContribution> joined_;
    std::vector<PilotContribution> merged_;
    std::vector<PilotLamp> lamps_;
    RenderStats stats_;
};

}  // namespace bdpt
