#pragma once

#include <bdpt/types.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <limits>

namespace bdpt {

/// Bound of the relative error after `n` rounded operations [Higham 2002, sec. 3.1].
[[nodiscard]] constexpr float rounding_bound(int n)
{
    constexpr float half_ulp = std::numeric_limits<float>::epsilon() * 0.5f;
    return static_cast<float>(n) * half_ulp / (1.0f - static_cast<float>(n) * half_ulp);
}

/// Where a ray that leaves a surface in direction `w` starts: moved along the normal until it is
/// surely on the side of `w`, whatever the rounding of `p` (bounded by `error`) and of the
/// intersection test [Pharr et al. 2023, Physically Based Rendering, sec. 6.8]. `ng` is unit, or
/// zero for a point that is on no surface.
[[nodiscard]] inline Vec3 offset_origin(Vec3 p, Vec3 error, Vec3 ng, Vec3 w)
{
    // The intersection test rounds a few times more than the point did.
    constexpr float safety = 4.0f;
    const float distance = safety * dot(abs(ng), error);
    return p + (dot(ng, w) < 0.0f ? -distance : distance) * ng;
}

}  // namespace bdpt
