#pragma once

#include "integrator/integrator.h"
#include "pilot/candidate_moments.h"
#include "pilot/path_shares.h"
#include "pilot/pilot_grid.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt {

/// A path that a pilot found, attributed to the pixels of a cell.
struct PilotContribution {
    std::size_t cell;
    PathShares shares;
    double number = 1.0;  ///< of found paths for which it stands, at least 1
};

/// Splats of a part of a pilot's light paths. They cover the whole image, while the camera paths of
/// a pilot are in one pixel of each cell.
class PilotSplats {
public:
    /// Traces the light paths of sample `index`; the pilot has `light_paths` per pixel of the
    /// image.
    void trace(Integrator& integrator, std::int64_t part, std::int64_t index, const PilotGrid& grid,
               Heuristic heuristic, double light_paths);

    [[nodiscard]] const std::vector<PilotContribution>& contributions() const
    {
        return contributions_;
    }
    [[nodiscard]] const RenderStats& stats() const { return stats_; }

private:
    std::vector<PilotContribution> contributions_;
    RenderStats stats_;
};

/// Maximum number of paths that are all kept.
inline constexpr std::size_t kept_paths = 8;

/// If `paths` has more than `kept_paths` from `first` on, keeps about as many of these, whose
/// `number` grows so that sums over all paths remain unbiased. The chance of each grows with its
/// light and with its error, so the brightest are kept. `random` selects the random number.
void keep_some(std::vector<PilotContribution>& paths, std::size_t first, std::uint64_t random);

/// Contributions of the camera paths in the pixel of a cell.
struct PilotCell {
    /// Minimum number of samples from which the square of a mean can be estimated.
    static constexpr int samples = 2;

    /// Returns the mean of the paths that they find well [nit].
    [[nodiscard]] double mean() const { return 0.5 * (values[0] + values[1]); }
    /// Returns an estimate of the variance of that mean [nit^2].
    [[nodiscard]] double variance() const
    {
        const double difference = values[0] - values[1];
        return 0.25 * difference * difference;
    }

    std::array<double, samples> values{};  ///< of the paths that each sample finds well [nit]
    std::array<VarianceOfSamples, PathShares::scattering_kinds> sums;  ///< of paths of each kind
    RenderStats stats;                                                 ///< work of its samples
};

/// A point on a light seen through the lens (s = t = 1).
struct PilotLamp {
    int x;  ///< pixel column
    int y;
    std::size_t cell;
    double value;     ///< contribution to the pixel if this strategy were alone [nit]
    double radiance;  ///< radiance of the light there [nit]
    double odds;      ///< density of this strategy over that of s = 0
    double mean;      ///< contribution to the brightness of its cell [nit]
};

/// The cells of one row of a pilot's grid.
class PilotRow {
public:
    /// Number of samples in each cell.
    static constexpr int samples_of_cell = PilotCell::samples;

    /// Adds sample `index` of every cell. `integrator` connects each camera path to
    /// `PathShares::pilot_connections` of its traced light paths, of which there are `light_paths`
    /// per pixel of the image, and merges it with all.
    void render(const Integrator& integrator, const PilotGrid& grid, Heuristic heuristic, int row,
                std::int64_t index, double light_paths);

    [[nodiscard]] const std::vector<PilotCell>& cells() const { return cells_; }
    /// Returns paths of two edges and more; where a camera path found many, some stand for all.
    [[nodiscard]] const std::vector<PilotContribution>& joined() const { return joined_; }
    /// Returns paths that were found by merging, likewise.
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

/// All contributions that a pilot has found.
struct PilotContributions {
    PilotGrid grid;
    double light_paths;  ///< light paths per pixel of the image
    std::vector<PilotRow> rows;
    std::vector<PilotSplats> parts;  ///< splats of its light paths

    /// Returns the number of camera paths over which their contributions are averaged.
    [[nodiscard]] double camera_paths() const
    {
        return static_cast<double>(grid.cells()) * PilotRow::samples_of_cell;
    }
    /// Returns the number of pixel samples over which splats of light paths are averaged: each
    /// sample covers all pixels.
    [[nodiscard]] double splatted_pixels() const
    {
        return grid.pixels() * PilotRow::samples_of_cell;
    }
};

}  // namespace bdpt
