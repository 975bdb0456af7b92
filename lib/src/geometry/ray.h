#pragma once

#include "math/random_numbers.h"
#include "math/side_media.h"

#include <bdpt/types.h>

#include <glm/geometric.hpp>

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

/// One end of a segment of a path, with the data needed to trace a ray from or to it.
struct SegmentEnd {
    Vec3 p{0.0f};
    float error = 0.0f;  ///< bound of the error of p and of the surface hit there [m]
    Vec3 ng{0.0f};       ///< unit geometric normal on the front; zero if not on a surface
    /// Sphere that contains p; segments touch spheres from outside only.
    std::uint32_t sphere = no_sphere;
    /// Media on both sides, or around a point that is not on a surface.
    SideMedia media{};
};

}  // namespace bdpt
