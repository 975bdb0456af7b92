#include "light/environment/environment_visibility.h"

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

}  // namespace bdpt
