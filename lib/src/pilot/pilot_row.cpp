#include "pilot/pilot_row.h"

#include "math/rgb.h"
#include "pilot/sample_moments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace bdpt {
namespace {

constexpr int n = PilotRow::samples_of_cell;

/// The part of the variance of independent samples that Sobol points leave, as measured in the
/// project's scenes with 32 samples: nothing of what is seen directly, little of direct light, half
/// of the rest; splats gain nothing.
struct LeftBySobol {
    double own = 0.0;        // s <= 1
    double connected = 0.0;  // s, t >= 2, and products of different paths
};

constexpr LeftBySobol left_by_sobol(int edges)
{
    return edges <= 1   ? LeftBySobol{}
           : edges == 2 ? LeftBySobol{.own = 0.25, .connected = 0.25}
                        : LeftBySobol{.own = 0.6, .connected = 0.4};
}

/// More connections of a sample are more points of one sequence, which leave less of the variance
/// of each: measured in rooms with 32 samples.
PerCandidate<double> left_by_more_connections()
{
    PerCandidate<double> result;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        result[k] = 1.0 / std::sqrt(std::sqrt(std::max(1.0, candidates[k].connections)));
    }
    return result;
}

using Samples = std::array<SampleMoments, n>;

/// Variance of what a camera path brings, without the squares of single paths.
double variance_of_sums(const Samples& samples, std::size_t candidate)
{
    double cross = 0.0;
    double sum = 0.0;
    double squares = 0.0;
    for (const SampleMoments& sample : samples) {
        cross += sample.cross_terms(candidate);
        const double value = sample.value(candidate);
        sum += value;
        squares += value * value;
    }
    // Products of different samples: an unbiased estimate of the mean's square.
    return cross / n - (sum * sum - squares) / (n * (n - 1));
}

PilotLamp seen_lamp(const PathContribution& path, std::size_t cell)
{
    const auto value = static_cast<double>(luminance(path.unweighted));
    return {.x = static_cast<int>(std::floor(path.raster.x)),
            .y = static_cast<int>(std::floor(path.raster.y)),
            .cell = cell,
            .value = value,
            // What s = 0 would bring if it were alone.
            .radiance = value * static_cast<double>(path.shares[1] / path.shares[0]),
            .weight = static_cast<double>(path.weight)};
}

}  // namespace

PerCandidate<double> remaining_variances(const PathShares& shares)
{
    const PathShares::SecondMoments moments = shares.second_moments();
    const LeftBySobol left = left_by_sobol(shares.edges());
    static const PerCandidate<double> of_connections = left_by_more_connections();
    PerCandidate<double> result;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        result[k] = left.own * moments.own[k] +
                    left.connected * of_connections[k] * moments.connections[k] + moments.splats[k];
    }
    return result;
}

void PilotRow::render(const Integrator& integrator, const PilotGrid& grid, Heuristic heuristic,
                      int row)
{
    cells_.reserve(static_cast<std::size_t>(grid.columns()));
    for (int column = 0; column < grid.columns(); ++column) {
        cells_.push_back(render_cell(integrator, grid, heuristic, grid.pixel(column, row)));
    }
}

PilotCell PilotRow::render_cell(const Integrator& integrator, const PilotGrid& grid,
                                Heuristic heuristic, const Tile& pixel)
{
    constexpr int direct_edges = 2;
    PilotCell cell;
    Samples direct{};
    Samples indirect{};
    std::size_t number = 0;
    const std::function<void(const PathContribution&)> observer =
        [&](const PathContribution& path) {
            const PathShares shares(path, heuristic);
            if (path.strategy.t <= 1) {
                const std::size_t seen_in = grid.cell_at(path.raster);
                splats_.push_back({.cell = seen_in, .shares = shares});
                if (path.strategy == Strategy{.s = 1, .t = 1} && path.shares[0] > 0.0f) {
                    lamps_.push_back(seen_lamp(path, seen_in));
                }
                return;
            }
            cell.mean += shares.camera_mean() / n;
            const PerCandidate<double> variances = remaining_variances(shares);
            for (std::size_t k = 0; k < candidates.size(); ++k) {
                cell.variances[k] += variances[k] / n;
            }
            if (shares.edges() >= direct_edges) {
                (shares.edges() == direct_edges ? direct : indirect)[number].add(path, shares);
            }
        };
    StrategyFilm no_strategies(PixelRect{}, {});
    const Films films{.film = nullptr, .strategies = no_strategies, .on_path = observer};
    for (; number < n; ++number) {
        const auto index = static_cast<std::int64_t>(number);
        stats_ += integrator.render_tile(pixel, {.begin = index, .end = index + 1}, films);
    }
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        cell.variances[k] +=
            left_by_sobol(direct_edges).connected * variance_of_sums(direct, k) +
            left_by_sobol(direct_edges + 1).connected * variance_of_sums(indirect, k);
    }
    return cell;
}

}  // namespace bdpt
