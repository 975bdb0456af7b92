#include "pilot/pilot_contributions.h"

#include "math/random_numbers.h"
#include "math/rgb.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>

namespace bdpt {
namespace {

/// N of each group (own, lights, splats, connections) and candidate, to some power.
using Factors = std::array<PerCandidate<double>, 4>;

constexpr Factors numbers(int power)
{
    Factors factors{};
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const std::array<double, 4> samples{1.0, candidates[k].light_samples,
                                            candidates[k].light_paths, candidates[k].connections};
        for (std::size_t group = 0; group < samples.size(); ++group) {
            factors[group][k] = 1.0;
            for (int i = 0; i < power; ++i) {
                factors[group][k] *= samples[group];
            }
        }
    }
    return factors;
}

constexpr Factors counts = numbers(1);
constexpr Factors squared_counts = numbers(2);
constexpr Factors cubed_counts = numbers(3);

}  // namespace

PathShares::Group PathShares::find_group(int s, int t)
{
    return s == 0 || (s == 1 && t == 1) ? own : s == 1 ? lights : t <= 1 ? splats : connections;
}

PathShares::Kind PathShares::find_kind(const PathContribution& path)
{
    const std::size_t edges = path.shares.size() - 2;
    return path.scatters_in_body ? in_body : edges < 2 ? seen : edges == 2 ? direct : indirect;
}

PathShares::PathShares(const PathContribution& path, Heuristic heuristic, double light_paths)
    : used_(find_group(path.strategy.s, path.strategy.t)),
      kind_(find_kind(path)),
      squares_(heuristic == Heuristic::power)
{
    const PerGroup samples{1.0, 1.0, light_paths, pilot_connections};
    const float found = path.shares[static_cast<std::size_t>(path.strategy.s)];
    used_share_ = static_cast<double>(found) / samples[used_];
    mean_ = luminance(path.unweighted) * (path.merged ? path.chance * path.weight : found);
    if (used_ == connections && !path.merged) {
        choice_share_ = static_cast<double>(path.chance) / pilot_rays;
    }
    const int vertices = static_cast<int>(path.shares.size()) - 1;
    float of_light = 0.0f;
    for (int s = 0; s <= vertices; ++s) {
        const Group group = find_group(s, vertices - s);
        of_light += vertices - s <= 1 ? path.shares[static_cast<std::size_t>(s)] : 0.0f;
        const double share =
            static_cast<double>(path.shares[static_cast<std::size_t>(s)]) / samples[group];
        shares_[group] += share;
        raised_[group] += raise(share);
        moments_[group] += squares_ ? share * share * share : share;
    }
    if (!(found_by_one() > 0.0)) {
        return;  // only merging finds it
    }
    constexpr float often = pilot_constants.sampling.often;
    const float of_camera = 1.0f - of_light;
    const bool by_camera = path.strategy.t >= 2;
    if (by_camera && of_camera >= often) {
        camera_mean_ = mean_ / of_camera;
    } else if (!by_camera && of_camera < often) {
        splat_mean_ = mean_ / of_light;
    }
}

PerCandidate<double> PathShares::numbers() const
{
    PerCandidate<double> result;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        result[k] = shares_[own] + counts[lights][k] * shares_[lights] +
                    counts[splats][k] * shares_[splats] +
                    counts[connections][k] * shares_[connections];
    }
    return result;
}

PerCandidate<double> PathShares::sums() const
{
    const Factors& raised = squares_ ? squared_counts : counts;
    PerCandidate<double> result;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        result[k] = raised_[own] + raised[lights][k] * raised_[lights] +
                    raised[splats][k] * raised_[splats] +
                    raised[connections][k] * raised_[connections];
    }
    return result;
}

PerCandidate<double> PathShares::weights() const
{
    const PerCandidate<double>& ratio = (squares_ ? squared_counts : counts)[used_];
    const double share = raise(used_share_);
    PerCandidate<double> result = sums();
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const double sum = result[k];
        result[k] = ratio[k] * share / (sum > 0.0 ? sum : 1.0);
    }
    return result;
}

PerCandidate<double> PathShares::own_values() const
{
    const PerCandidate<double>& of_mean = (squares_ ? squared_counts : counts)[lights];
    const PerCandidate<double>& of_square = (squares_ ? cubed_counts : counts)[lights];
    PerCandidate<double> result = sums();
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const double mean = result[k] * (raised_[own] + of_mean[k] * raised_[lights]);
        const double square = moments_[own] + of_square[k] * moments_[lights];
        result[k] = mean > 0.0 ? static_cast<double>(mean_) * square / mean : 0.0;
    }
    return result;
}

PathShares::SecondMoments PathShares::second_moments() const
{
    const Factors& factors = squares_ ? cubed_counts : counts;
    const double square = static_cast<double>(mean_) * static_cast<double>(mean_);
    const double of_hits = square * moments_[own];
    const double of_lights = square * moments_[lights];
    const double of_splats = square * moments_[splats];
    const double of_connections = square * moments_[connections];
    const PerCandidate<double> all = sums();
    SecondMoments result;
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const double scale = 1.0 / (all[k] > 0.0 ? all[k] * all[k] : 1.0);
        result.own[k] = all[k] > 0.0 ? scale * (of_hits + factors[lights][k] * of_lights)
                                     : std::numeric_limits<double>::infinity();
        result.splats[k] = scale * factors[splats][k] * of_splats;
        result.connections[k] = scale * factors[connections][k] * of_connections;
        // Chosen with a chance below 1, a contribution is divided by it.
        const double chance = candidates[k].connection_rays * choice_share_ * pilot_connections /
                              std::max(1.0, candidates[k].connections);
        const bool rare = chance > 0.0 && chance < 1.0;
        result.choice[k] = rare ? result.connections[k] * (1.0 / chance - 1.0) : 0.0;
    }
    return result;
}

void CandidateMoments::add(const PathContribution& path, const PathShares& shares)
{
    const auto unweighted = static_cast<double>(luminance(path.unweighted));
    const PerCandidate<double> weights = shares.weights();
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        const double weighted = weights[k] * unweighted;
        if (path.strategy.s <= 1) {
            own_[k].add(weighted);
            lights_[k] += path.strategy.s == 1 ? weighted : 0.0;
        } else {
            connected_[static_cast<std::size_t>(path.light_path)][k].add(
                weighted * PathShares::pilot_connections);
        }
    }
}

double CandidateMoments::value(std::size_t k) const
{
    const bool connects = candidates[k].connections > 0.0;
    const double both = connected_[0][k].total + connected_[1][k].total;
    return own_[k].total + (connects ? 0.5 * both : 0.0);
}

double CandidateMoments::cross_terms(std::size_t k) const
{
    // E[(A + (B_1 + ... + B_c) / c)^2] without squares of single paths. Below one connection, only
    // the fraction c of the camera paths has one.
    const double c = candidates[k].connections;
    const Sum& own = own_[k];
    if (c == 0.0) {
        return own.products();
    }
    const Sum& first = connected_[0][k];
    const Sum& second = connected_[1][k];
    return own.products() + own.total * (first.total + second.total) +
           0.5 * (first.products() + second.products()) / c +
           std::max(0.0, 1.0 - 1.0 / c) * first.total * second.total;
}

void VarianceOfSamples::add(const CandidateMoments& sample)
{
    for (std::size_t k = 0; k < candidates.size(); ++k) {
        cross_[k] += sample.cross_terms(k);
        const double value = sample.value(k);
        sums_[k] += value;
        squares_[k] += value * value;
        const double lights = sample.light_samples(k);
        lights_[k] += lights;
        squares_of_lights_[k] += lights * lights;
    }
}

double VarianceOfSamples::variance(std::size_t k, int samples) const
{
    // Products of different samples: an unbiased estimate of the mean's square.
    const double pairs = static_cast<double>(samples) * (samples - 1);
    const double mean_square = (sums_[k] * sums_[k] - squares_[k]) / pairs;
    // Products of different light samples of a vertex, of which the pilot has one, as if they were
    // independent; points of one vertex are so well distributed that no more is left.
    const double of_lights = (1.0 - 1.0 / candidates[k].light_samples) *
                             (lights_[k] * lights_[k] - squares_of_lights_[k]) / pairs;
    return cross_[k] / samples + of_lights - mean_square;
}

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
