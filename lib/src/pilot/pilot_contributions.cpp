#include "pilot/pilot_contributions.h"

#include "math/random_numbers.h"
#include "math/rgb.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>

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

}  // namespace bdpt
