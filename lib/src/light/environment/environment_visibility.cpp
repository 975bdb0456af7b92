#include "light/environment/environment_visibility.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace bdpt {
namespace {

/// Minimum number of trials in a cell: cells are split while their halves have about as many.
constexpr std::ptrdiff_t trials_of_cell = 400;
constexpr int max_depth = 32;
/// Weight of the parent cell's probabilities, in trials.
constexpr float prior = 4.0f;

}  // namespace

EnvironmentVisibility::EnvironmentVisibility(std::vector<Trial> trials)
{
    nodes_.emplace_back();
    build(0, trials.begin(), trials.end(), Probabilities(EnvironmentTiles::tile_count, 1.0f), 0);
}

void EnvironmentVisibility::build(std::uint32_t node, std::vector<Trial>::iterator begin,
                                  std::vector<Trial>::iterator end, const Probabilities& of_parent,
                                  int depth)
{
    // Counts are exact integers, so that their order does not matter.
    std::vector<float> tried(EnvironmentTiles::tile_count, 0.0f);
    std::vector<float> visible(EnvironmentTiles::tile_count, 0.0f);
    Vec3 lower(std::numeric_limits<float>::infinity());
    Vec3 upper = -lower;
    for (auto trial = begin; trial != end; ++trial) {
        tried[trial->tile] += 1.0f;
        visible[trial->tile] += trial->visible ? 1.0f : 0.0f;
        lower = min(lower, trial->p);
        upper = max(upper, trial->p);
    }
    Probabilities here(EnvironmentTiles::tile_count);
    for (std::size_t tile = 0; tile < here.size(); ++tile) {
        here[tile] = (visible[tile] + prior * of_parent[tile]) / (tried[tile] + prior);
    }

    const Vec3 size = upper - lower;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    if (end - begin >= 2 * trials_of_cell && depth < max_depth && size[axis] > 0.0f) {
        const auto middle = begin + (end - begin) / 2;
        std::nth_element(begin, middle, end,
                         [axis](const Trial& a, const Trial& b) { return a.p[axis] < b.p[axis]; });
        const float split = middle->p[axis];
        const auto second = std::partition(
            begin, end, [axis, split](const Trial& trial) { return trial.p[axis] < split; });
        if (second != begin) {
            const auto child = static_cast<std::uint32_t>(nodes_.size());
            nodes_[node] = {.split = split, .axis = axis, .next = child};
            nodes_.resize(nodes_.size() + 2);
            build(child, begin, second, here, depth + 1);
            build(child + 1, second, end, here, depth + 1);
            return;
        }
    }
    nodes_[node] = {.split = 0.0f, .axis = leaf, .next = static_cast<std::uint32_t>(cells_.size())};
    TileFactors& factors = cells_.emplace_back();
    for (std::size_t tile = 0; tile < here.size(); ++tile) {
        // The variance is minimal if the share of samples is proportional to the root of the second
        // moment.
        factors.of[tile] = std::max(min_factor, std::sqrt(here[tile]));
    }
}

}  // namespace bdpt
