#include "light/tree/light_bounds.h"

#include "math/elementary.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace bdpt {
namespace {

float sine(float cosine)
{
    return std::sqrt(std::max(0.0f, (1.0f - cosine) * (1.0f + cosine)));
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

}  // namespace bdpt
