#pragma once

#include "math/segment_key.h"

#include <bdpt/types.h>

#include <cstdint>
#include <limits>

namespace bdpt {

/// In the place of the number of a sphere: none.
inline constexpr std::uint32_t no_sphere = std::numeric_limits<std::uint32_t>::max();

struct Ray {
    Vec3 origin{0.0f};
    Vec3 direction{0.0f, 0.0f, 1.0f};  ///< any length; t is measured in it
    float t_max = std::numeric_limits<float>::infinity();
    /// The sphere that the ray starts or ends on, on the outside: it is convex, so only rounding
    /// could find it in the way.
    std::uint32_t ignored_sphere = no_sphere;
    SegmentKey segment{};  ///< decides which surfaces it passes
};

/// Where a ray met a triangle or a sphere.
struct RayHit {
    std::uint32_t instance = 0;  ///< of triangles
    std::uint32_t triangle = 0;
    Vec2 barycentrics{0.0f};           ///< of the second and third corner of a triangle
    Vec3 normal{0.0f};                 ///< geometric, on the front side, in world space, any length
    std::uint32_t sphere = no_sphere;  ///< its normal is unit
};

}  // namespace bdpt
