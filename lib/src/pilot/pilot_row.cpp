#include "pilot/pilot_row.h"

#include "math/rgb.h"
#include "pilot/kept_paths.h"

#include <cmath>
#include <cstdint>
#include <functional>

namespace bdpt {
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
