#include "light/tree/light_tree.h"

#include "light/tree/light_tree_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace bdpt {
namespace {

struct Angle {
    float cos;
    float sin;
};

float greater(float a, float b)
{
    return a > b ? a : b;
}

Angle to_angle(float cosine)
{
    return {cosine, std::sqrt(greater((1.0f - cosine) * (1.0f + cosine), 0.0f))};
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
