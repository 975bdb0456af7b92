#include "scene/medium.h"

#include "math/elementary.h"
#include "math/rgb.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace bdpt {
namespace {

Rgb attenuate(Rgb absorption, float distance)
{
    return {exp_exact(-absorption.r * distance), exp_exact(-absorption.g * distance),
            exp_exact(-absorption.b * distance)};
}

Rgb absorption_towards(const SegmentEnd& end, Vec3 w)
{
    if (end.media == nullptr) {
        return Rgb(0.0f);
    }
    return dot(end.ng, w) < 0.0f ? end.media->behind : end.media->ahead;
}

}  // namespace

Rgb absorbed_transmittance(const SegmentEnd& a, const SegmentEnd& b, Vec3 w,
                           float distance) noexcept
{
    const Rgb absorption = max(absorption_towards(a, w), absorption_towards(b, -w));
    return is_black(absorption) ? Rgb(1.0f) : attenuate(absorption, distance);
}

}  // namespace bdpt
