#pragma once

#include "integrator/integrator.h"
#include "pilot/path_shares.h"
#include "pilot/pilot_grid.h"

#include <vector>

namespace bdpt {

/// What a pilot found in the pixel of a cell.
struct PilotCell {
    double mean = 0.0;  ///< of what camera paths find well [nit]
    /// Of what a sample's camera path brings, and of the splats that could have been there instead
    /// [nit^2].
    PerCandidate<double> variances{};
};

/// A path that a splat found, for any pixel.
struct PilotSplat {
    std::size_t cell;
    PathShares shares;
};

/// A point of a lamp that is seen through the lens (s = t = 1).
struct PilotLamp {
    int x;  ///< of its pixel
    int y;
    std::size_t cell;
    double value;     ///< what it brings to the pixel, if this strategy were alone [nit]
    double radiance;  ///< of the lamp there [nit]
    double weight;    ///< of this strategy
};

/// The cells of one row of a pilot's grid.
class PilotRow {
public:
    /// The fewest from which the square of a mean can be told.
    static constexpr int samples_of_cell = 2;

    /// `integrator` has `PathShares::pilot_light_paths` of its own for each camera path.
    void render(const Integrator& integrator, const PilotGrid& grid, Heuristic heuristic, int row);

    [[nodiscard]] const std::vector<PilotCell>& cells() const { return cells_; }
    [[nodiscard]] const std::vector<PilotSplat>& splats() const { return splats_; }
    [[nodiscard]] const std::vector<PilotLamp>& lamps() const { return lamps_; }
    [[nodiscard]] const RenderStats& stats() const { return stats_; }

private:
    [[nodiscard]] PilotCell render_cell(const Integrator& integrator, const PilotGrid& grid,
                                        Heuristic heuristic, const Tile& pixel);

    std::vector<PilotCell> cells_;
    std::vector<PilotSplat> splats_;
    std::vector<PilotLamp> lamps_;
    RenderStats stats_;
};

/// What a path adds to the variances that are left when random numbers are well spread.
[[nodiscard]] PerCandidate<double> remaining_variances(const PathShares& shares);

}  // namespace bdpt
