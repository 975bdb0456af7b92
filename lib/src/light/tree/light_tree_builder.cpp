#include "light/tree/light_tree_builder.h"

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
/// Maximum number of lights, evenly chosen from a group, that determine its split.
constexpr std::size_t max_binned = 4096;
/// Below this depth lights are split in half whatever the cost, to bound the depth.
constexpr int deepest_choice = 16;

using Bins = std::array<std::optional<LightBounds>, bin_count>;

void add(std::optional<LightBounds>& sum, const LightBounds& bounds)
{
    sum = sum ? merged(*sum, bounds) : bounds;
}

/// Returns the cost of these lights in one node. Uses the square of the diagonal in place of the
/// area of the box, as collinear points have none, and nodes store spheres.
double cost(const LightBounds& bounds)
{
    const Vec3 diagonal = bounds.max - bounds.min;
    return bounds.intensity * static_cast<double>(dot(diagonal, diagonal)) *
           static_cast<double>(orientation_measure(bounds));
}

/// A split of the bins of an axis.
struct Division {
    double cost = std::numeric_limits<double>::infinity();
    int axis = 0;
    std::size_t first_bins = 0;
};

/// Returns the cheapest split; infinite cost if all lights are in one bin.
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
            continue;  // equal to the previous split
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

/// Returns the radius of a sphere around the box, slightly enlarged for rounding of corners and
/// sampled points.
float compute_radius(const LightBounds& bounds)
{
    const Vec3 half = 0.5f * bounds.max - 0.5f * bounds.min;
    const Vec3 farthest = max(abs(bounds.min), abs(bounds.max));
    constexpr float epsilon = std::numeric_limits<float>::epsilon();
    const float radius = 1.00001f * std::sqrt(dot(half, half)) +
                         8.0f * epsilon * std::max({farthest.x, farthest.y, farthest.z});
    return std::max(radius, 1e-15f);
}

}  // namespace

LightTreeBuilder::LightTreeBuilder(std::span<const LightBounds> lights) : lights_(lights)
{
    tree_.slots_.resize(lights.size());
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
    build(ids, LightTree::no_slot, 0);
}

LightTreeBuilder::Group LightTreeBuilder::make_group(std::span<std::uint32_t> ids) const
{
    LightBounds bounds = lights_[ids[0]];
    for (const std::uint32_t id : ids.subspan(1)) {
        bounds = merged(bounds, lights_[id]);
    }
    return {.ids = ids, .bounds = bounds, .cost = ids.size() > 1 ? cost(bounds) : 0.0};
}

void LightTreeBuilder::build(std::span<std::uint32_t> ids, std::uint32_t parent_slot, int depth)
{
    std::array<Group, LightTree::max_children> groups;
    std::size_t count = 1;
    if (ids.size() <= groups.size()) {
        for (count = 0; count < ids.size(); ++count) {
            groups[count] = make_group(ids.subspan(count, 1));
        }
    } else {
        groups[0] = make_group(ids);
    }
    while (count < groups.size()) {
        // Single lights have no cost; coincident ones may have none either.
        const auto dearest = std::max_element(
            groups.begin(), groups.begin() + static_cast<std::ptrdiff_t>(count),
            [](const Group& a, const Group& b) {
                return a.cost != b.cost ? a.cost < b.cost : a.ids.size() < b.ids.size();
            });
        if (dearest->ids.size() < 2) {
            break;
        }
        const std::span<std::uint32_t> all = dearest->ids;
        const std::size_t middle =
            depth < deepest_choice ? split(all, dearest->bounds) : all.size() / 2;
        *dearest = make_group(all.first(middle));
        groups[count] = make_group(all.subspan(middle));
        ++count;
    }
    const auto node = static_cast<std::uint32_t>(tree_.nodes_.size());
    const std::size_t first_quad = tree_.quads_.size();
    const std::size_t quad_count = (count + LightQuad::width - 1) / LightQuad::width;
    tree_.nodes_.push_back({.first_quad = static_cast<std::uint32_t>(first_quad),
                            .quad_count = static_cast<std::uint32_t>(quad_count),
                            .parent_slot = parent_slot});
    tree_.quads_.resize(first_quad + quad_count);
    tree_.owners_.resize(first_quad + quad_count, node);
    for (std::size_t i = 0; i < count; ++i) {
        put(groups[i], LightQuad::width * first_quad + i);
    }
    for (std::size_t i = 0; i < count; ++i) {
        if (groups[i].ids.size() < 2) {
            continue;
        }
        const std::size_t slot = LightQuad::width * first_quad + i;
        tree_.quads_[slot / LightQuad::width].group[slot % LightQuad::width] =
            static_cast<std::uint32_t>(tree_.nodes_.size());
        build(groups[i].ids, static_cast<std::uint32_t>(slot), depth + 1);
    }
}

/// Stores a group, except for its node index.
void LightTreeBuilder::put(const Group& group, std::size_t slot)
{
    const LightBounds& bounds = group.bounds;
    const Vec3 center = bounds.center();
    const Vec3 axis = bounds.normals.axis;
    const float cos_spread = bounds.normals.cos_angle;
    LightQuad& quad = tree_.quads_[slot / LightQuad::width];
    const std::size_t i = slot % LightQuad::width;
    quad.x[i] = center.x;
    quad.y[i] = center.y;
    quad.z[i] = center.z;
    quad.radius[i] = compute_radius(bounds);
    quad.axis_x[i] = axis.x;
    quad.axis_y[i] = axis.y;
    quad.axis_z[i] = axis.z;
    quad.cos_spread[i] = cos_spread;
    quad.sin_spread[i] = std::sqrt(std::max(0.0f, (1.0f - cos_spread) * (1.0f + cos_spread)));
    quad.cos_falloff[i] = bounds.cos_falloff;
    quad.intensity[i] = static_cast<float>(bounds.intensity * inverse_total_);
    quad.both_sides[i] = bounds.sides == EmittingSides::both ? 1.0f : 0.0f;
    if (group.ids.size() == 1) {
        quad.group[i] = LightQuad::single + group.ids[0];
        tree_.slots_[group.ids[0]] = static_cast<std::uint32_t>(slot);
    }
}

std::size_t LightTreeBuilder::split(std::span<std::uint32_t> ids, const LightBounds& whole) const
{
    if (ids.size() == 2) {
        return 1;
    }
    Vec3 low = lights_[ids[0]].center();
    Vec3 high = low;
    for (const std::uint32_t id : ids) {
        low = min(low, lights_[id].center());
        high = max(high, lights_[id].center());
    }
    const auto find_bin = [&](std::uint32_t id, int axis) {
        const float at = (lights_[id].center()[axis] - low[axis]) / (high[axis] - low[axis]);
        return std::min(static_cast<std::size_t>(at * static_cast<float>(bin_count)),
                        bin_count - 1);
    };
    const Vec3 extent = whole.max - whole.min;
    const float longest = std::max({extent.x, extent.y, extent.z});
    const std::size_t step = 1 + ids.size() / max_binned;
    Division best;
    for (int axis = 0; axis < 3; ++axis) {
        if (!(high[axis] > low[axis])) {
            continue;
        }
        Bins bins;
        for (std::size_t i = 0; i < ids.size(); i += step) {
            add(bins[find_bin(ids[i], axis)], lights_[ids[i]]);
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
        return find_bin(id, best.axis) < best.first_bins;
    });
    return static_cast<std::size_t>(middle - ids.begin());
}

}  // namespace bdpt
