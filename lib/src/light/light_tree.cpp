#include "light/light_tree.h"

#include "light/light_tree_builder.h"

#include <glm/geometric.hpp>

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

Angle angle_of(float cosine)
{
    return {cosine, std::sqrt(std::max(0.0f, (1.0f - cosine) * (1.0f + cosine)))};
}

/// a - b, and 0 where b is the greater.
Angle less(Angle a, Angle b)
{
    if (a.cos > b.cos) {
        return {1.0f, 0.0f};
    }
    return {a.cos * b.cos + a.sin * b.sin, std::max(0.0f, a.sin * b.cos - a.cos * b.sin)};
}

/// Cosines of small angles between large ones are off by less than this: what is darker by no more
/// than rounding still counts as lit.
constexpr float slack = 2e-3f;
// Lights at grazing angles keep a little, for the bounds say nothing about textures, spheres that
// rise above a horizon or shading normals.
constexpr float least_emitted = 0.01f;
constexpr float least_received = 0.05f;

}  // namespace

double LightTreeNode::importance(const LightReceiver& receiver) const noexcept
{
    const Vec3 to_center = center - receiver.p;
    const float distance_squared = dot(to_center, to_center);
    const double greatest = static_cast<double>(intensity);
    if (!(distance_squared > radius_squared)) {
        return greatest / static_cast<double>(radius_squared);
    }
    const float inverse_squared = 1.0f / distance_squared;
    const Vec3 w = to_center * std::sqrt(inverse_squared);
    const float sin2_size = radius_squared * inverse_squared;
    const Angle size{std::sqrt(std::max(0.0f, 1.0f - sin2_size)), std::sqrt(sin2_size)};
    float lit = 1.0f;
    if (cos_spread > -1.0f) {
        const float along = -dot(axis, w);
        const Angle from_axis = angle_of(sides == EmittingSides::both ? std::abs(along) : along);
        const float cosine = less(less(from_axis, {cos_spread, sin_spread}), size).cos;
        if (cosine < cos_falloff - slack) {
            return 0.0;
        }
        lit = std::max(cosine, least_emitted);
    }
    if (receiver.normal) {
        const float cosine = less(angle_of(dot(*receiver.normal, w)), size).cos;
        if (cosine < -slack) {
            return 0.0;
        }
        lit *= std::max(cosine, least_received);
    }
    return greatest * static_cast<double>(lit) / static_cast<double>(distance_squared);
}

LightTree::LightTree(std::span<const LightBounds> lights)
{
    LightTreeBuilder builder(lights);
    nodes_ = std::move(builder.nodes);
    trails_ = std::move(builder.trails);
}

std::optional<LightTree::Choice> LightTree::sample(const LightReceiver& receiver,
                                                   double u) const noexcept
{
    if (nodes_.empty()) {
        return std::nullopt;
    }
    const LightTreeNode* node = nodes_.data();
    double probability = 1.0;
    while (!node->is_leaf) {
        const LightTreeNode* children = &nodes_[node->content];
        const double first = children[0].importance(receiver);
        const double second = children[1].importance(receiver);
        const double sum = first + second;
        if (!(sum > 0.0)) {
            return std::nullopt;
        }
        const double share = first / sum;
        if (u < share) {
            node = &children[0];
            probability *= share;
            u /= share;
        } else {
            const double rest = second / sum;
            node = &children[1];
            probability *= rest;
            constexpr double below_one = 1.0 - 0x1p-53;
            u = std::min((u - share) / rest, below_one);
        }
    }
    const auto rounded = static_cast<float>(probability);
    if (!(rounded >= std::numeric_limits<float>::min())) {
        return std::nullopt;
    }
    return Choice{.light = node->content, .probability = rounded};
}

float LightTree::probability(std::uint32_t light, const LightReceiver& receiver) const noexcept
{
    const LightTreeNode* node = nodes_.data();
    std::uint64_t trail = trails_[light];
    double probability = 1.0;
    while (!node->is_leaf) {
        const LightTreeNode* children = &nodes_[node->content];
        const double first = children[0].importance(receiver);
        const double second = children[1].importance(receiver);
        const bool takes_second = (trail & 1U) != 0;
        const double taken = takes_second ? second : first;
        if (!(taken > 0.0)) {
            return 0.0f;
        }
        probability *= taken / (first + second);
        node = &children[takes_second ? 1 : 0];
        trail >>= 1U;
    }
    const auto rounded = static_cast<float>(probability);
    return rounded >= std::numeric_limits<float>::min() ? rounded : 0.0f;
}

}  // namespace bdpt
