#include "light/light_tree.h"

#include "math/elementary.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace bdpt {
namespace {

float greater(float a, float b)
{
    return a > b ? a : b;
}

float sine(float cosine)
{
    return std::sqrt(greater((1.0f - cosine) * (1.0f + cosine), 0.0f));
}

/// Tests whether `narrow` is within `wide`; `cos_between` is the cosine between their axes.
bool contains(const DirectionCone& wide, const DirectionCone& narrow, float cos_between)
{
    if (wide.is_whole()) {
        return true;
    }
    const float sin_between = sine(cos_between);
    const float sin_narrow = sine(narrow.cos_angle);
    const bool below_pi = sin_between * narrow.cos_angle + cos_between * sin_narrow >= 0.0f;
    return below_pi && cos_between * narrow.cos_angle - sin_between * sin_narrow >= wide.cos_angle;
}

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

struct Angle {
    float cos;
    float sin;
};

Angle to_angle(float cosine)
{
    return {cosine, sine(cosine)};
}

/// Returns the angle in [0, pi / 2] with that sine.
Angle angle_of_sine(float sine)
{
    return {to_angle(sine).sin, sine};
}

/// Returns a - b, or 0 if b is larger.
Angle less(Angle a, Angle b)
{
    const float cosine = a.cos * b.cos + a.sin * b.sin;
    const float sine = a.sin * b.cos - a.cos * b.sin;
    return {a.cos > b.cos ? 1.0f : cosine, a.cos > b.cos ? 0.0f : greater(sine, 0.0f)};
}

/// Error bound for cosines of small angles between large ones: groups that are dark by no more than
/// this still count as lit.
constexpr float slack = 2e-3f;
// Minimum factors at grazing angles, because the bounds ignore textures, spheres that extend above
// a horizon and shading normals.
constexpr float min_emitted = 0.01f;
constexpr float min_received = 0.05f;

/// Converts a probability to float: 0 if it is not a normal number.
float usable(double probability)
{
    const auto rounded = static_cast<float>(probability);
    return rounded >= std::numeric_limits<float>::min() ? rounded : 0.0f;
}

}  // namespace

DirectionCone merged(const DirectionCone& a, const DirectionCone& b)
{
    const DirectionCone& wide = a.cos_angle <= b.cos_angle ? a : b;
    const DirectionCone& narrow = a.cos_angle <= b.cos_angle ? b : a;
    const float cos_between = std::clamp(dot(a.axis, b.axis), -1.0f, 1.0f);
    if (contains(wide, narrow, cos_between)) {
        return wide;
    }
    // Exceeds the rounding error, so that no number of unions loses a direction.
    constexpr float margin = 4e-6f;
    const auto compute_cos = [](float angle) {
        return angle < pi ? std::max(sin_cos(angle).cos - margin, -1.0f) : -1.0f;
    };
    const float between = acos_exact(cos_between);
    const float wide_angle = acos_exact(wide.cos_angle);
    const float narrow_angle = acos_exact(narrow.cos_angle);
    const float angle = 0.5f * (wide_angle + between + narrow_angle);
    if (angle >= pi) {
        return {.axis = wide.axis, .cos_angle = -1.0f};
    }
    const Vec3 across = narrow.axis - cos_between * wide.axis;
    const float length = std::sqrt(dot(across, across));
    constexpr float parallel = 1e-5f;  // below this the axes define no plane of rotation
    if (length < parallel) {
        return {.axis = wide.axis, .cos_angle = compute_cos(between + narrow_angle)};
    }
    const SinCos turn = sin_cos(angle - wide_angle);
    return {.axis = normalize(turn.cos * wide.axis + turn.sin * (across / length)),
            .cos_angle = compute_cos(angle)};
}

void LightBounds::contain(Vec3 p)
{
    min = glm::min(min, p);
    max = glm::max(max, p);
}

LightBounds merged(const LightBounds& a, const LightBounds& b)
{
    const bool both = a.sides == EmittingSides::both || b.sides == EmittingSides::both;
    DirectionCone other = b.normals;
    if (both && dot(a.normals.axis, other.axis) < 0.0f) {
        other.axis = -other.axis;  // the closer of two opposite axes that are equivalent
    }
    return {.min = min(a.min, b.min),
            .max = max(a.max, b.max),
            .normals = merged(a.normals, other),
            .cos_falloff = std::min(a.cos_falloff, b.cos_falloff),
            .sides = both ? EmittingSides::both : EmittingSides::front,
            .intensity = a.intensity + b.intensity};
}

float orientation_measure(const LightBounds& bounds)
{
    const float spread = acos_exact(bounds.normals.cos_angle);
    const float reach = std::min(pi, spread + acos_exact(bounds.cos_falloff));
    const SinCos of_spread = sin_cos(spread);
    const float beyond = 2.0f * reach * of_spread.sin - sin_cos(spread - 2.0f * reach).cos -
                         2.0f * spread * of_spread.sin + of_spread.cos;
    const float one_side = 2.0f * pi * (1.0f - of_spread.cos) + 0.5f * pi * beyond;
    return bounds.sides == EmittingSides::both ? std::min(2.0f * one_side, 4.0f * pi) : one_side;
}

/// Builds the tree top-down by the surface area orientation heuristic over bins of light centres
/// [Conty Estevez and Kulla 2018, sec. 4.4]. The groups of a node are split, the most costly first,
/// until it has the maximum number of children.
class LightTreeBuilder {
public:
    explicit LightTreeBuilder(std::span<const LightBounds> lights);

    /// Moves the tree out; may be called once.
    [[nodiscard]] LightTree take() { return std::move(tree_); }

private:
    struct Group {
        std::span<std::uint32_t> ids;
        LightBounds bounds;
        double cost = 0.0;
    };

    [[nodiscard]] Group make_group(std::span<std::uint32_t> ids) const;
    void build(std::span<std::uint32_t> ids, std::uint32_t parent_slot, int depth);
    /// Partitions `ids` and returns the size of the first part.
    [[nodiscard]] std::size_t split(std::span<std::uint32_t> ids, const LightBounds& whole) const;
    void put(const Group& group, std::size_t slot);

    std::span<const LightBounds> lights_;
    double inverse_total_ = 1.0;
    LightTree tree_;
};

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
    quad.sin_spread[i] = sine(cos_spread);
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

LightQuad::Four<double> LightQuad::importance(const LightSampleContext& receiver) const noexcept
{
    const Vec3 p = receiver.p;
    const Vec3 normal = receiver.normal.value_or(Vec3(0.0f));
    const float min_cosine = receiver.normal ? -1.0f : 1.0f;
    Four<float> factor;
    Four<float> squared;
    // Branch-free and with one number type, so that it is vectorized over all four.
    for (std::size_t i = 0; i < width; ++i) {
        const float dx = x[i] - p.x;
        const float dy = y[i] - p.y;
        const float dz = z[i] - p.z;
        const float to_center = dx * dx + dy * dy + dz * dz;
        const float inside = radius[i] * radius[i];
        const float distance_squared = to_center > inside ? to_center : inside;
        const float inverse = 1.0f / std::sqrt(distance_squared);
        const Angle size = angle_of_sine(radius[i] * inverse);

        const float along = -inverse * (axis_x[i] * dx + axis_y[i] * dy + axis_z[i] * dz);
        const Angle from_axis = to_angle(both_sides[i] > 0.0f ? std::abs(along) : along);
        const float emitted = less(less(from_axis, {cos_spread[i], sin_spread[i]}), size).cos;
        const float above = inverse * (normal.x * dx + normal.y * dy + normal.z * dz);
        const float received = greater(less(to_angle(above), size).cos, min_cosine);

        float cosines = greater(emitted, min_emitted) * greater(received, min_received);
        cosines = emitted >= cos_falloff[i] - slack ? cosines : 0.0f;
        cosines = received >= -slack ? cosines : 0.0f;
        factor[i] = to_center > inside ? cosines : 1.0f;  // inside of the sphere angles are unknown
        squared[i] = distance_squared;
    }
    Four<double> result;
    for (std::size_t i = 0; i < width; ++i) {
        result[i] = static_cast<double>(intensity[i]) * static_cast<double>(factor[i]) /
                    static_cast<double>(squared[i]);
    }
    return result;
}

LightTree::LightTree(std::span<const LightBounds> lights)
{
    *this = LightTreeBuilder(lights).take();
}

LightTree::View LightTree::look(const Node& node, const LightSampleContext& receiver) const noexcept
{
    View view;
    for (std::uint32_t q = 0; q < node.quad_count; ++q) {
        const auto part = quads_[node.first_quad + q].importance(receiver);
        for (std::size_t i = 0; i < LightQuad::width; ++i) {
            view.importance[LightQuad::width * q + i] = part[i];
            view.sum += part[i];
        }
    }
    return view;
}

std::optional<LightTree::Choice> LightTree::sample(const LightSampleContext& receiver,
                                                   double u) const noexcept
{
    if (nodes_.empty()) {
        return std::nullopt;
    }
    double probability = 1.0;
    for (const Node* node = nodes_.data();;) {
        const View view = look(*node, receiver);
        if (!(view.sum > 0.0)) {
            return std::nullopt;
        }
        // The last lit child takes the rounding error.
        double rest = u * view.sum;
        std::size_t chosen = 0;
        double share = 0.0;
        for (std::size_t i = 0; i < LightQuad::width * node->quad_count; ++i) {
            if (view.importance[i] > 0.0) {
                rest -= share;
                chosen = i;
                share = view.importance[i];
                if (rest < share) {
                    break;
                }
            }
        }
        probability *= share / view.sum;
        constexpr double below_one = 1.0 - 0x1p-53;
        u = std::clamp(rest / share, 0.0, below_one);
        const LightQuad& quad = quads_[node->first_quad + chosen / LightQuad::width];
        const std::uint32_t group = quad.group[chosen % LightQuad::width];
        if ((group & LightQuad::single) != 0) {
            const float rounded = usable(probability);
            return rounded > 0.0f ? std::optional(Choice{group - LightQuad::single, rounded})
                                  : std::nullopt;
        }
        node = &nodes_[group];
    }
}

float LightTree::probability(std::uint32_t light, const LightSampleContext& receiver) const noexcept
{
    double probability = 1.0;
    for (std::uint32_t slot = slots_[light]; slot != no_slot;) {
        const auto quad = static_cast<std::uint32_t>(slot / LightQuad::width);
        const Node& node = nodes_[owners_[quad]];
        const View view = look(node, receiver);
        const double own = view.importance[slot - LightQuad::width * std::size_t{node.first_quad}];
        if (!(own > 0.0)) {
            return 0.0f;
        }
        probability *= own / view.sum;
        slot = node.parent_slot;
    }
    return usable(probability);
}

}  // namespace bdpt
