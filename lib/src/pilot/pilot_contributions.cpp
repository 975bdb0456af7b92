#include "pilot/pilot_contributions.h"

#include "math/random_numbers.h"
#include "math/rgb.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <utility>

namespace bdpt {

void PilotSplats::trace(Integrator& integrator, std::int64_t part, std::int64_t index,
                        const PilotGrid& grid, Heuristic heuristic, double light_paths)
{
    const std::function<void(const PathContribution&)> observer =
        [&](const PathContribution& path) {
            contributions_.push_back({.cell = grid.cell_at(path.raster),
                                      .shares = PathShares(path, heuristic, light_paths)});
        };
    StrategyFilm no_strategies(PixelRect{}, {});
    const Films films{.film = nullptr, .strategies = no_strategies, .on_path = observer};
    stats_ += integrator.render_chunk(part, {.begin = index, .end = index + 1}, films);
}

namespace {

/// A path's part of the sums that are estimated from all.
struct Part {
    double light;  ///< [nit]
    /// Squared error when found by one light path per camera path [nit^2]; 0 if no candidate can.
    double error;
};

Part part_of(const PilotContribution& path)
{
    const double mean = path.shares.mean();
    const double found = path.shares.found_by_one();
    return {.light = path.number * mean,
            .error = found > 0.0 ? path.number * mean * mean / found : 0.0};
}

double fraction(double part, double sum)
{
    return sum > 0.0 ? part / sum : 0.0;
}

}  // namespace

void keep_some(std::vector<PilotContribution>& paths, std::size_t first, std::uint64_t random)
{
    constexpr std::size_t kept_paths = pilot_constants.sampling.kept_paths;
    if (paths.size() - first <= kept_paths) {
        return;
    }
    Part all{};
    for (std::size_t i = first; i < paths.size(); ++i) {
        const Part part = part_of(paths[i]);
        all.light += part.light;
        all.error += part.error;
    }
    // Systematic sampling: one random number, then equal steps through the sum of all chances.
    constexpr double half = 0.5 * static_cast<double>(kept_paths);
    double at = static_cast<double>(split_mix(random) >> 11U) * 0x1p-53;
    std::size_t end = first;
    for (std::size_t i = first; i < paths.size(); ++i) {
        const Part part = part_of(paths[i]);
        const double chance = std::min(
            1.0, half * (fraction(part.light, all.light) + fraction(part.error, all.error)));
        at += chance;
        if (at >= 1.0) {
            at -= 1.0;
            paths[end] = paths[i];
            paths[end++].number /= chance;
        }
    }
    paths.erase(paths.begin() + static_cast<std::ptrdiff_t>(end), paths.end());
}

namespace {

PilotLamp seen_lamp(const PathContribution& path, const PathShares& shares, std::size_t cell)
{
    const auto value = static_cast<double>(luminance(path.unweighted));
    const auto odds = static_cast<double>(path.shares[1] / path.shares[0]);
    return {.x = static_cast<int>(std::floor(path.raster.x)),
            .y = static_cast<int>(std::floor(path.raster.y)),
            .cell = cell,
            .value = value,
            // The estimate of s = 0 if it were alone.
            .radiance = value * odds,
            .odds = odds,
            .mean = shares.splat_mean()};
}

}  // namespace

void PilotRow::render(const Integrator& integrator, const PilotGrid& grid, Heuristic heuristic,
                      int row, std::int64_t index, double light_paths)
{
    cells_.resize(static_cast<std::size_t>(grid.columns()));
    PilotCell* cell = nullptr;
    std::size_t cell_index = 0;
    std::array<CandidateMoments, PathShares::scattering_kinds> moments;
    const std::function<void(const PathContribution&)> observer =
        [&](const PathContribution& path) {
            const PathShares shares(path, heuristic, light_paths);
            if (path.strategy.t <= 1) {  // s = t = 1: light paths have been traced before
                if (path.shares[0] > 0.0f) {
                    lamps_.push_back(seen_lamp(path, shares, grid.cell_at(path.raster)));
                }
                return;
            }
            const double number = path.merged ? 1.0 / static_cast<double>(path.chance) : 1.0;
            cell->values[static_cast<std::size_t>(index)] += number * shares.camera_mean();
            if (path.merged) {
                merged_.push_back({.cell = cell_index, .shares = shares, .number = number});
            } else if (shares.kind() != PathShares::seen) {
                joined_.push_back({.cell = cell_index, .shares = shares});
                moments[shares.kind()].add(path, shares);
            }
        };
    StrategyFilm no_strategies(PixelRect{}, {});
    const Films films{.film = nullptr, .strategies = no_strategies, .on_path = observer};
    for (int column = 0; column < grid.columns(); ++column) {
        cell = &cells_[static_cast<std::size_t>(column)];
        cell_index = grid.index(column, row);
        moments = {};
        const std::size_t joined_before = joined_.size();
        const std::size_t merged_before = merged_.size();
        const RenderStats stats = integrator.render_tile(grid.pixel(column, row),
                                                         {.begin = index, .end = index + 1}, films);
        stats_ += stats;
        cell->stats += stats;
        for (std::size_t kind = 0; kind < PathShares::scattering_kinds; ++kind) {
            cell->sums[kind].add(moments[kind]);
        }
        const std::uint64_t random =
            cell_index * std::uint64_t{samples_of_cell} + static_cast<std::uint64_t>(index);
        keep_some(joined_, joined_before, random);
        keep_some(merged_, merged_before, ~random);
    }
}

namespace {

/// Returns the index of a row or column, or of its mirror image beyond the edge.
int mirrored(int index, int size)
{
    const int period = 2 * size;
    const int within = (index % period + period) % period;
    return within < size ? within : period - 1 - within;
}

/// Returns the means of `reach` cells on either side of each, and of itself. `neighbour` returns
/// the index of the cell that is `i` cells from a column and row.
template <typename Neighbour>
std::vector<double> averaged_along(const PilotGrid& grid, const std::vector<double>& values,
                                   int reach, const Neighbour& neighbour)
{
    std::vector<double> result;
    result.reserve(values.size());
    for (int row = 0; row < grid.rows(); ++row) {
        for (int column = 0; column < grid.columns(); ++column) {
            double sum = 0.0;
            for (int i = -reach; i <= reach; ++i) {
                sum += values[neighbour(column, row, i)];
            }
            result.push_back(sum / (2 * reach + 1));
        }
    }
    return result;
}

/// Returns the means over squares around each cell, which extend over `reach` cells on every side.
std::vector<double> averaged(const PilotGrid& grid, const std::vector<double>& values, int reach)
{
    const std::vector<double> along_rows =
        averaged_along(grid, values, reach, [&](int column, int row, int i) {
            return grid.index(mirrored(column + i, grid.columns()), row);
        });
    return averaged_along(grid, along_rows, reach, [&](int column, int row, int i) {
        return grid.index(column, mirrored(row + i, grid.rows()));
    });
}

/// Brightness by camera paths and by splats, and the variance of the sum of both.
struct CellBrightness {
    std::vector<double> camera;
    std::vector<double> splats;
    std::vector<double> variances;

    /// Returns means over squares around each cell, and the variances of these means.
    [[nodiscard]] CellBrightness around(const PilotGrid& grid, int reach) const
    {
        CellBrightness result{.camera = averaged(grid, camera, reach),
                              .splats = averaged(grid, splats, reach),
                              .variances = averaged(grid, variances, reach)};
        const int side = 2 * reach + 1;
        for (double& variance : result.variances) {
            variance /= side * side;
        }
        return result;
    }
    [[nodiscard]] bool light_is_rare() const
    {
        double lit = 0.0;
        double by_few = 0.0;
        for (std::size_t i = 0; i < camera.size(); ++i) {
            const double mean = camera[i] + splats[i];
            lit += mean > 0.0 ? 1.0 : 0.0;
            by_few +=
                mean * mean < pilot_constants.sampling.fewest_paths * variances[i] ? 1.0 : 0.0;
        }
        return by_few > pilot_constants.sampling.rare_fraction * lit;
    }
};

}  // namespace

PilotBrightness::PilotBrightness(const PilotContributions& contributions)
{
    const PilotGrid& grid = contributions.grid;
    const double share_of_splat =
        static_cast<double>(grid.cells()) / contributions.splatted_pixels();
    CellBrightness cells{
        .camera = {}, .splats = std::vector<double>(grid.cells()), .variances = {}};
    for (const PilotRow& row : contributions.rows) {
        for (const PilotCell& cell : row.cells()) {
            cells.camera.push_back(cell.mean());
            cells.variances.push_back(cell.variance());
        }
        for (const PilotLamp& lamp : row.lamps()) {
            cells.splats[lamp.cell] += lamp.mean / PilotRow::samples_of_cell;
        }
    }
    for (const PilotSplats& part : contributions.parts) {
        for (const PilotContribution& splat : part.contributions()) {
            const double value = splat.shares.splat_mean() * share_of_splat;
            cells.splats[splat.cell] += value;
            cells.variances[splat.cell] += value * value;
        }
    }
    for (std::size_t i = 0; i < grid.cells(); ++i) {
        average_ += (cells.camera[i] + cells.splats[i]) / static_cast<double>(grid.cells());
    }
    int reach = 1;
    CellBrightness around = cells.around(grid, reach);
    light_is_rare_ = around.light_is_rare();
    for (bool rare = light_is_rare_; rare && 2 * reach + 1 < std::max(grid.columns(), grid.rows());
         rare = around.light_is_rare()) {
        reach *= 2;
        around = cells.around(grid, reach);
    }
    camera_ = std::move(around.camera);
    splats_ = std::move(around.splats);
    share_of_splat_ = share_of_splat / ((2 * reach + 1) * (2 * reach + 1));
}

double PilotBrightness::compute_scale(std::size_t cell, double less) const
{
    const double mean = camera_[cell] + std::max(0.0, splats_[cell] - less);
    const double square = mean * mean + pilot_constants.sampling.epsilon * average_ * average_;
    return square > 0.0 ? 1.0 / square : 0.0;
}

}  // namespace bdpt
