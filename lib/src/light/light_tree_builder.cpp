#include "light/light_tree_builder.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace bdpt {
namespace {

constexpr std::size_t bin_count = 12;
/// Below this depth lights are halved whatever that costs, so that a trail of 64 bits is enough for
/// all numbers of lights of 32 bits.
constexpr std::uint32_t deepest_choice = 30;

using Bins = std::array<std::optional<LightBounds>, bin_count>;

void add(std::optional<LightBounds>& sum, const LightBounds& bounds)
{
    sum = sum ? merged(*sum, bounds) : bounds;
}

/// What it costs to have these lights in one node. By the square of the diagonal in place of the
/// area of the box, for points on a line have none, and it is a sphere that a node keeps.
double cost(const LightBounds& bounds)
{
    const Vec3 diagonal = bounds.max - bounds.min;
    return bounds.intensity * static_cast<double>(dot(diagonal, diagonal)) *
           static_cast<double>(orientation_measure(bounds));
}

/// A division of the bins of an axis.
struct Division {
    double cost = std::numeric_limits<double>::infinity();
    int axis = 0;
    std::size_t first_bins = 0;
};

/// The cheapest; none when all lights are in one bin.
Division cheapest(const Bins& bins, int axis, double elongation)
{
    std::array<double, bin_count> after{};
    std::optional<LightBounds> sum;
    for (std::size_t i = bin_count; i-- > 1;) {
        if (bins[i]) {
            add(sum, *bins[i]);
        }
        after[i] = !sum ? -1.0 : bins[i] ? cost(*sum) : after[i + 1];
    }
    Division best{.axis = axis};
    sum.reset();
    for (std::size_t i = 1; i < bin_count && after[i] >= 0.0; ++i) {
        if (!bins[i - 1]) {
            continue;  // the same as the one before
        }
        add(sum, *bins[i - 1]);
        const double both = elongation * (cost(*sum) + after[i]);
        if (both < best.cost) {
            best.cost = both;
            best.first_bins = i;
        }
    }
    return best;
}

LightTreeNode node_around(const LightBounds& bounds, double inverse_total)
{
    const Vec3 half = 0.5f * bounds.max - 0.5f * bounds.min;
    const Vec3 farthest = max(abs(bounds.min), abs(bounds.max));
    constexpr float epsilon = std::numeric_limits<float>::epsilon();
    // A little more, so that rounding leaves nothing outside, neither corners nor sampled points.
    const float radius = 1.00001f * std::sqrt(dot(half, half)) +
                         8.0f * epsilon * std::max({farthest.x, farthest.y, farthest.z});
    const float cos_spread = bounds.normals.cos_angle;
    return {.center = bounds.center(),
            .radius_squared = std::max(radius * radius, 1e-30f),
            .axis = bounds.normals.axis,
            .cos_spread = cos_spread,
            .sin_spread = std::sqrt(std::max(0.0f, (1.0f - cos_spread) * (1.0f + cos_spread))),
            .cos_falloff = bounds.cos_falloff,
            .intensity = static_cast<float>(bounds.intensity * inverse_total),
            .sides = bounds.sides};
}

}  // namespace

LightTreeBuilder::LightTreeBuilder(std::span<const LightBounds> lights)
    : trails(lights.size()), lights_(lights)
{
    if (lights.empty()) {
        return;
    }
    double total = 0.0;
    for (const LightBounds& light : lights) {
        total += light.intensity;
    }
    inverse_total_ = 1.0 / total;
    std::vector<std::uint32_t> ids(lights.size());
    std::iota(ids.begin(), ids.end(), 0U);
    nodes.reserve(2 * lights.size() - 1);
    nodes.emplace_back();
    build(ids, {});
}

void LightTreeBuilder::build(std::span<std::uint32_t> ids, Place place)
{
    LightBounds whole = lights_[ids[0]];
    for (const std::uint32_t id : ids.subspan(1)) {
        whole = merged(whole, lights_[id]);
    }
    LightTreeNode node = node_around(whole, inverse_total_);
    if (ids.size() == 1) {
        node.is_leaf = true;
        node.content = ids[0];
        trails[ids[0]] = place.trail;
        nodes[place.node] = node;
        return;
    }
    const auto first_child = static_cast<std::uint32_t>(nodes.size());
    node.content = first_child;
    nodes[place.node] = node;
    nodes.resize(nodes.size() + 2);
    const std::size_t middle =
        place.depth < deepest_choice && ids.size() > 2 ? split(ids, whole) : ids.size() / 2;
    build(ids.first(middle), {.node = first_child, .depth = place.depth + 1, .trail = place.trail});
    build(ids.subspan(middle), {.node = first_child + 1,
                                .depth = place.depth + 1,
                                .trail = place.trail | std::uint64_t{1} << place.depth});
}

std::size_t LightTreeBuilder::split(std::span<std::uint32_t> ids, const LightBounds& whole)
{
    Vec3 low = lights_[ids[0]].center();
    Vec3 high = low;
    for (const std::uint32_t id : ids) {
        low = min(low, lights_[id].center());
        high = max(high, lights_[id].center());
    }
    const auto bin_of = [&](std::uint32_t id, int axis) {
        const float at = (lights_[id].center()[axis] - low[axis]) / (high[axis] - low[axis]);
        return std::min(static_cast<std::size_t>(at * static_cast<float>(bin_count)),
                        bin_count - 1);
    };
    const Vec3 extent = whole.max - whole.min;
    const float longest = std::max({extent.x, extent.y, extent.z});
    Division best;
    for (int axis = 0; axis < 3; ++axis) {
        if (!(high[axis] > low[axis])) {
            continue;
        }
        Bins bins;
        for (const std::uint32_t id : ids) {
            add(bins[bin_of(id, axis)], lights_[id]);
        }
        const Division division = cheapest(bins, axis, static_cast<double>(longest / extent[axis]));
        if (division.cost < best.cost) {
            best = division;
        }
    }
    if (best.first_bins == 0) {
        return ids.size() / 2;
    }
    const auto middle = std::partition(ids.begin(), ids.end(), [&](std::uint32_t id) {
        return bin_of(id, best.axis) < best.first_bins;
    });
    return static_cast<std::size_t>(middle - ids.begin());
}

}  // namespace bdpt
