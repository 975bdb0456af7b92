#pragma once

#include "math/random_numbers.h"

#include <bdpt/types.h>

#include <cstdint>
#include <limits>

namespace bdpt {

/// Index that stands for no sphere.
inline constexpr std::uint32_t no_sphere = std::numeric_limits<std::uint32_t>::max();

struct Ray {
    Vec3 origin{0.0f};
    Vec3 direction{0.0f, 0.0f, 1.0f};  ///< any length; the unit of t
    float t_max = std::numeric_limits<float>::infinity();
    /// The sphere that the ray starts or ends on, on the outside: it is convex, so only rounding
    /// could make it block the ray.
    std::uint32_t ignored_sphere = no_sphere;
    SegmentKey segment{};  ///< decides which surfaces the ray passes
};

/// A point computed in floats, with a bound [m] of its error and that of an intersection test of
/// its triangle, in any direction.
struct BoundedPoint {
    Vec3 p{0.0f};
    float error = 0.0f;
};

/// Intersection of a line with the plane of a triangle.
struct TriangleHit {
    Vec2 barycentrics{0.0f};  ///< weights of the second and third vertex
    Vec3 ng{0.0f};            ///< unit geometric normal on the front; zero without an area
    BoundedPoint point;
};

/// Hit of a triangle or a sphere.
struct RayHit {
    std::uint32_t instance = 0;  ///< for triangles
    std::uint32_t triangle = 0;
    TriangleHit at;  ///< for spheres: the normal only
    std::uint32_t sphere = no_sphere;
};

}  // namespace bdpt
