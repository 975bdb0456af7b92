#include "light/tree/light_bounds.h"

#include "math/elementary.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace bdpt {

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
