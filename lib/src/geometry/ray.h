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

/// A point that was computed in floats, with a bound of how far off [m] it and an intersection test
/// of its triangle can be, in any direction.
struct BoundedPoint {
    Vec3 p{0.0f};
    float error = 0.0f;
};

/// Where a line crosses the plane of a triangle.
struct TriangleHit {
    Vec2 barycentrics{0.0f};  ///< of the second and third corner
    Vec3 ng{0.0f};            ///< unit geometric normal on the front; zero without an area
    BoundedPoint point;
};

/// Where a ray met a triangle or a sphere.
struct RayHit {
    std::uint32_t instance = 0;  ///< of triangles
    std::uint32_t triangle = 0;
    TriangleHit at;  ///< of spheres the normal only
    std::uint32_t sphere = no_sphere;
};

}  // namespace bdpt
