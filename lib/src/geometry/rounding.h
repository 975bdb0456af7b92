#pragma once

#include <bdpt/types.h>

#include <glm/geometric.hpp>

#include <limits>

namespace bdpt {

/// Returns a bound of the relative error after `n` rounded operations [Higham 2002, sec. 3.1].
[[nodiscard]] constexpr float rounding_bound(int n)
{
    constexpr float half_ulp = std::numeric_limits<float>::epsilon() * 0.5f;
    return static_cast<float>(n) * half_ulp / (1.0f - static_cast<float>(n) * half_ulp);
}

/// Returns the origin of a ray that leaves a surface in direction `w`, avoiding self-intersection:
/// the point is moved along the normal until it is certainly on the side of `w`, whatever the
/// rounding of `p` and of the intersection test, both bounded by `error` [Pharr et al. 2023,
/// Physically Based Rendering, sec. 6.8]. `ng` is unit, or zero for a point that is not on a
/// surface.
[[nodiscard]] inline Vec3 offset_origin(Vec3 p, float error, Vec3 ng, Vec3 w)
{
    return p + (dot(ng, w) < 0.0f ? -error : error) * ng;
}

}  // namespace bdpt
