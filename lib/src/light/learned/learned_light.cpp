#include "light/learned/learned_light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

namespace bdpt {
namespace {

using Trial = EnvironmentVisibility::Trial;

/// A cell is divided while its halves have about as many trials each.
constexpr std::size_t trials_of_cell = 400;

/// Probability of each tile to be visible from a part of space.
using Probabilities = std::vector<float>;

/// Estimates them from the trials in that part and the probabilities of the part around it. Counts
/// are integers, so the order of trials does not matter.
Probabilities probabilities(std::span<const Trial> trials, const Probabilities& around)
{
    constexpr float prior = 4.0f;  // what is known counts as so many trials
    std::vector<float> tried(EnvironmentTiles::tile_count, 0.0f);
    std::vector<float> visible(EnvironmentTiles::tile_count, 0.0f);
    for (const Trial& trial : trials) {
        tried[trial.tile] += 1.0f;
        visible[trial.tile] += trial.visible ? 1.0f : 0.0f;
    }
    Probabilities here(EnvironmentTiles::tile_count);
    for (std::size_t tile = 0; tile < here.size(); ++tile) {
        here[tile] = (visible[tile] + prior * around[tile]) / (tried[tile] + prior);
    }
    return here;
}

/// The share of samples that has the least variance goes with the root of the second moment.
TileFactors compute_factors(const Probabilities& visible)
{
    TileFactors factors;
    for (std::size_t tile = 0; tile < visible.size(); ++tile) {
        factors.of[tile] = std::max(EnvironmentVisibility::min_factor, std::sqrt(visible[tile]));
    }
    return factors;
}

}  // namespace

EnvironmentVisibility::EnvironmentVisibility(std::vector<Trial> trials)
    : cells_(std::span(trials), trials_of_cell, Probabilities(EnvironmentTiles::tile_count, 1.0f),
             probabilities, compute_factors)
{}

namespace {

using Finding = GroupShares::Finding;

constexpr std::size_t findings_of_cell = 400;

/// Mean squares of the contributions of light samples, per group.
using MeanSquares = std::array<double, GroupShares::max_groups>;

/// Estimates them from the findings in a part of space and the mean squares of the part around it.
MeanSquares mean_squares(std::span<const Finding> findings, const MeanSquares& around)
{
    constexpr double prior = 16.0;  // what is known counts as so many findings
    constexpr double parts = 0x1p36;
    std::array<float, GroupShares::max_groups> greatest{};
    for (const Finding& finding : findings) {
        greatest[finding.group] = std::max(greatest[finding.group], finding.value);
    }
    // Squares as whole numbers of parts of the greatest one: exact, so that their order does not
    // matter.
    std::array<std::uint64_t, GroupShares::max_groups> sums{};
    std::array<std::uint64_t, GroupShares::max_groups> counts{};
    for (const Finding& finding : findings) {
        ++counts[finding.group];
        if (finding.value > 0.0f) {
            const double ratio =
                static_cast<double>(finding.value) / static_cast<double>(greatest[finding.group]);
            sums[finding.group] += static_cast<std::uint64_t>(ratio * ratio * parts);
        }
    }
    MeanSquares found{};
    double sum_found = 0.0;
    double sum_around = 0.0;
    for (std::size_t group = 0; group < found.size(); ++group) {
        const auto most = static_cast<double>(greatest[group]);
        found[group] = static_cast<double>(sums[group]) / parts * (most * most);
        sum_found += counts[group] > 0 ? found[group] / static_cast<double>(counts[group]) : 0.0;
        sum_around += around[group];
    }
    if (!(sum_found > 0.0)) {
        return around;
    }
    // Only the proportions of `around` count, as a part may be far darker than its surroundings.
    const double scale = sum_around > 0.0 ? sum_found / sum_around : 0.0;
    MeanSquares here{};
    for (std::size_t group = 0; group < here.size(); ++group) {
        here[group] = (found[group] + prior * scale * around[group]) /
                      (static_cast<double>(counts[group]) + prior);
    }
    return here;
}

GroupShares::Shares shares_by(const MeanSquares& squares, std::size_t groups)
{
    // The shares that have the least variance go with the roots of the second moments.
    double sum = 0.0;
    for (const double square : squares) {
        sum += std::sqrt(square);
    }
    const double even = 1.0 / static_cast<double>(groups);
    GroupShares::Shares shares{};
    for (std::size_t group = 0; group < groups; ++group) {
        const double found = sum > 0.0 ? std::sqrt(squares[group]) / sum : even;
        shares[group] = static_cast<float>((1.0 - GroupShares::even_part) * found +
                                           GroupShares::even_part * even);
    }
    return shares;
}

}  // namespace

GroupShares::GroupShares(std::vector<Finding> findings, std::size_t groups)
    : cells_(std::span(findings), findings_of_cell, MeanSquares{}, mean_squares,
             [groups](const MeanSquares& squares) { return shares_by(squares, groups); })
{}

}  // namespace bdpt
