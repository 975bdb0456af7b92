#pragma once

#include "integrator/integrator.h"
#include "math/random_numbers.h"
#include "pilot/candidates.h"
#include "pilot/pilot_constants.h"

#include <bdpt/path_contribution.h>
#include <bdpt/render_options.h>
#include <bdpt/types.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt {

/// A path that a pilot found, reweighted for any numbers of light paths and connections. With a_s =
/// p_s over the density with which the pilot finds such paths, merges included, a candidate has N_s
/// a_s; N_s is 1 for s = 0, or its number of light samples relative to the pilot's, of light paths
/// or of connections. Luminance represents all channels.
class PathShares {
public:
    /// Number of light paths to which a camera path of the pilot is connected.
    static constexpr int pilot_connections = pilot_constants.sampling.connections;
    /// Its connection rays: so many that nearly all connections are made.
    static constexpr double pilot_rays = pilot_constants.sampling.connection_rays;
    /// Paths by how much Sobol points improve them; those of `seen` lights do not scatter.
    enum Kind : std::size_t { direct, indirect, in_body, seen };
    static constexpr std::size_t scattering_kinds = seen;

    /// The pilot weighted the path by the balance heuristic, and had `light_paths` per pixel of the
    /// image. `heuristic` is that of the candidates, balance or power.
    PathShares(const PathContribution& path, Heuristic heuristic, double light_paths);

    /// Returns the path's contribution to the mean of its pixel [nit]: if camera paths (t >= 2)
    /// find such paths often enough, only they count, for they contribute to that very pixel; else
    /// only splats count.
    [[nodiscard]] double camera_mean() const { return camera_mean_; }
    [[nodiscard]] double splat_mean() const { return splat_mean_; }
    [[nodiscard]] Kind kind() const { return kind_; }
    /// Returns the path's contribution to the mean of its pixel [nit].
    [[nodiscard]] double mean() const { return static_cast<double>(mean_); }
    /// Returns how often one light path per camera path, one light sample of a vertex, and one
    /// connection find such paths, relative to the pilot; 0 if no candidate can.
    [[nodiscard]] double found_by_one() const
    {
        return shares_[own] + shares_[lights] + shares_[splats] + shares_[connections];
    }
    /// Returns how often each candidate finds such paths, relative to the pilot. Each time they
    /// bring the mean over this number, with balance weights.
    [[nodiscard]] PerCandidate<double> numbers() const;
    /// Returns each candidate's weight of the strategy that found the path.
    [[nodiscard]] PerCandidate<double> weights() const;

    /// The path's contribution to the sum of the second moments of all strategies of a candidate,
    /// weighted and divided by their numbers of samples: it stands for the paths that any of them
    /// finds, so that paths rarely found by one are observed by another [Grittmann et al. 2022,
    /// "Efficiency-Aware Multiple Importance Sampling for Bidirectional Rendering Algorithms"].
    struct SecondMoments {
        PerCandidate<double> own;          ///< s <= 1; infinite if the candidate has no such path
        PerCandidate<double> splats;       ///< t <= 1
        PerCandidate<double> connections;  ///< s, t >= 2, if all connections are made
        /// What is added if the candidate chooses among them; 0 if no connection found the path.
        PerCandidate<double> choice;
    };
    [[nodiscard]] SecondMoments second_moments() const;
    /// Returns the contribution of the candidate's strategies with s <= 1 when they find such a
    /// path: their part of the second moment over that of the mean [nit].
    [[nodiscard]] PerCandidate<double> own_values() const;
    /// Returns whether a connection found the path, so that the pilot knows how often candidates
    /// would choose it.
    [[nodiscard]] bool choice_is_known() const { return choice_share_ > 0.0; }

private:
    /// Strategies with the same number of samples: s = 0 and s = t = 1; s = 1 and t >= 2; s >= 2
    /// and t <= 1; s, t >= 2.
    enum Group : std::size_t { own, lights, splats, connections, groups };
    using PerGroup = std::array<double, groups>;

    [[nodiscard]] static Group find_group(int s, int t);
    [[nodiscard]] static Kind find_kind(const PathContribution& path);
    /// Applies the heuristic's function to a share.
    [[nodiscard]] double raise(double share) const { return squares_ ? share * share : share; }
    /// Returns the sums of raise(N a) over all strategies.
    [[nodiscard]] PerCandidate<double> sums() const;

    float mean_;  ///< by the balance heuristic of all strategies and merges
    float camera_mean_ = 0.0f;
    float splat_mean_ = 0.0f;
    double used_share_;
    /// Share of the connection that found the path in the choice among those to the pilot's light
    /// paths; with more light paths it is smaller in proportion. 0 if no connection found it.
    double choice_share_ = 0.0;
    Group used_;
    Kind kind_;
    bool squares_;
    PerGroup shares_{};   ///< sums of a
    PerGroup raised_{};   ///< sums of raise(a)
    PerGroup moments_{};  ///< sums of raise(a)^2 / a
};

/// Contribution of one camera path of a pilot to its own pixel, for all candidates at once.
class CandidateMoments {
public:
    /// Adds `path`, which was found by a strategy with t >= 2; `shares` are its shares.
    void add(const PathContribution& path, const PathShares& shares);

    /// Returns the value of the candidate's sample.
    [[nodiscard]] double value(std::size_t candidate) const;
    /// Returns the part of that value that light samples bring.
    [[nodiscard]] double light_samples(std::size_t candidate) const { return lights_[candidate]; }
    /// Returns the second moment of that value, without the squares of single paths.
    [[nodiscard]] double cross_terms(std::size_t candidate) const;

private:
    struct Sum {
        double total = 0.0;
        double squares = 0.0;
        void add(double value)
        {
            total += value;
            squares += value * value;
        }
        /// Returns the sum of all products of two different values.
        [[nodiscard]] double products() const { return total * total - squares; }
    };

    PerCandidate<Sum> own_{};        ///< contributions of the camera path alone (s <= 1)
    PerCandidate<double> lights_{};  ///< the part of these with s = 1
    /// Contributions of the connections to each light path, as if it were the only one.
    std::array<PerCandidate<Sum>, PathShares::pilot_connections> connected_{};
};

/// Variance of the contributions of a pixel's camera paths, from independent samples.
class VarianceOfSamples {
public:
    void add(const CandidateMoments& sample);
    /// Returns the variance without the squares of single paths, after `samples` samples, at least
    /// two.
    [[nodiscard]] double variance(std::size_t candidate, int samples) const;

private:
    PerCandidate<double> cross_{};
    PerCandidate<double> sums_{};
    PerCandidate<double> squares_{};
    PerCandidate<double> lights_{};
    PerCandidate<double> squares_of_lights_{};
};

/// A grid of cells over the whole image; a pilot samples one pixel of each cell.
class PilotGrid {
public:
    /// Has at most `max_cells`.
    PilotGrid(int width, int height, double max_cells = pilot_constants.sampling.max_cells)
        : width_(width), height_(height)
    {
        const double pixels = static_cast<double>(width) * static_cast<double>(height);
        constexpr const PilotSampling& sampling = pilot_constants.sampling;
        const double enough =
            std::max(sampling.cells_per_pixel * pixels, std::min(sampling.min_cells, pixels));
        const double cells = std::min(enough, max_cells);
        const double side = std::sqrt(pixels / cells);
        columns_ = std::clamp(static_cast<int>(std::lround(width / side)), 1, width);
        rows_ = std::clamp(static_cast<int>(std::lround(height / side)), 1, height);
    }
    [[nodiscard]] int columns() const { return columns_; }
    [[nodiscard]] int rows() const { return rows_; }
    /// Returns the number of pixels of the image.
    [[nodiscard]] double pixels() const
    {
        return static_cast<double>(width_) * static_cast<double>(height_);
    }
    [[nodiscard]] int width() const { return width_; }    ///< of the image [pixels]
    [[nodiscard]] int height() const { return height_; }  ///< of the image [pixels]
    [[nodiscard]] std::size_t cells() const { return index(0, rows_); }
    [[nodiscard]] std::size_t index(int column, int row) const
    {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(column);
    }
    /// Returns the cell at `raster`.
    [[nodiscard]] std::size_t cell_at(Vec2 raster) const
    {
        return index(cell(raster.x, columns_, width_), cell(raster.y, rows_, height_));
    }
    /// Returns the column of cells of each column of pixels.
    [[nodiscard]] std::vector<int> columns_of_pixels() const { return spread(columns_, width_); }
    /// Returns the row of cells of each row of pixels.
    [[nodiscard]] std::vector<int> rows_of_pixels() const { return spread(rows_, height_); }
    /// Returns the pixel of a cell, at a random position in it.
    [[nodiscard]] Tile pixel(int column, int row) const
    {
        const std::uint64_t random = split_mix(golden_ratio_64 * (index(column, row) + 1));
        const int x = place(column, columns_, width_, static_cast<std::uint32_t>(random));
        const int y = place(row, rows_, height_, static_cast<std::uint32_t>(random >> 32U));
        return {.x_begin = x, .x_end = x + 1, .y_begin = y, .y_end = y + 1};
    }

private:
    static int place(int cell, int cells, int pixels, std::uint32_t random)
    {
        const double at = (cell + static_cast<double>(random) * 0x1p-32) * pixels / cells;
        return std::min(static_cast<int>(at), pixels - 1);
    }
    static int cell(float raster, int cells, int pixels)
    {
        return std::clamp(static_cast<int>(static_cast<double>(raster) * cells / pixels), 0,
                          cells - 1);
    }

    static std::vector<int> spread(int cells, int pixels)
    {
        std::vector<int> result;
        result.reserve(static_cast<std::size_t>(pixels));
        for (int i = 0; i < pixels; ++i) {
            result.push_back(cell(static_cast<float>(i) + 0.5f, cells, pixels));
        }
        return result;
    }

    int width_;
    int height_;
    int columns_;
    int rows_;
};

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

/// If `paths` has more than `PilotSampling::kept_paths` from `first` on, keeps about as many of
/// these, whose `number` grows so that sums over all paths remain unbiased. The chance of each
/// grows with its light and with its error, so the brightest are kept. `random` selects the random
/// number.
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

/// Brightness of the image in each cell and its neighbourhood, estimated from a pilot's
/// contributions: errors are relative to it. A single cell has too few samples: if they happened to
/// be dark, errors of splats would be overestimated by far. The neighbourhood has 3 x 3 cells, more
/// where light is rare in the whole image: relative to a brightness that is its own, each path
/// would have the same error, whatever it brings.
class PilotBrightness {
public:
    explicit PilotBrightness(const PilotContributions& contributions);

    /// Returns the factor of squared errors in relMSE [1/nit^2]; 0 in black images.
    [[nodiscard]] double scale(std::size_t cell) const { return compute_scale(cell, 0.0); }
    /// Returns that factor for the error of a splat of a light path. The splat's own brightness is
    /// excluded: rare splats would hide their own error.
    [[nodiscard]] double scale(const PilotContribution& splat) const
    {
        return compute_scale(splat.cell, splat.shares.splat_mean() * share_of_splat_);
    }

    /// Returns the mean of the image, excluding light that only merging finds [nit].
    [[nodiscard]] double average() const { return average_; }

    /// Returns whether light is so rare in the whole image that much of it, cell by cell, comes
    /// from a single path of the pilot.
    [[nodiscard]] bool light_is_rare() const { return light_is_rare_; }

private:
    [[nodiscard]] double compute_scale(std::size_t cell, double less) const;

    std::vector<double> camera_;  ///< from camera paths [nit]
    std::vector<double> splats_;  ///< from splats [nit]
    double share_of_splat_;       ///< fraction of one splat in `splats_`
    double average_ = 0.0;        ///< mean of the image [nit]
    bool light_is_rare_ = false;  ///< in squares of 3 x 3 cells
};

}  // namespace bdpt
