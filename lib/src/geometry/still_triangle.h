#pragma once

#include "geometry/length.h"
#include "geometry/ray.h"

#include <glm/geometric.hpp>

#include <array>

namespace bdpt {

/// Precomputed data of a static triangle for each hit, in one cache line.
struct alignas(64) StillTriangle {
    Vec3 corner{0.0f};        ///< first vertex, in world space
    float error = 0.0f;       ///< as in `BoundedPoint`, for points given by barycentrics
    Vec3 to_b{0.0f};          ///< edge from the first to the second vertex
    Vec3 to_c{0.0f};          ///< edge from the first to the third vertex
    Vec3 ng{0.0f};            ///< unit, on the front; zero without an area
    float twice_area = 0.0f;  ///< negative if the front has clockwise vertices

    /// `front_sign` as in `PlacedMesh`.
    StillTriangle(const std::array<Vec3, 3>& corners, float front_sign, float error_of_points)
        : corner(corners[0]),
          error(error_of_points),
          to_b(corners[1] - corners[0]),
          to_c(corners[2] - corners[0])
    {
        const Vec3 normal = front_sign * cross(to_b, to_c);
        const float length = compute_length(normal);
        if (length > 0.0f) {
            ng = normal / length;
            twice_area = front_sign * length;
        }
    }

    [[nodiscard, gnu::always_inline]] inline BoundedPoint point(Vec2 barycentrics) const
    {
        return {corner + (barycentrics.x * to_b + barycentrics.y * to_c), error};
    }
    /// Intersects the line of the ray with the plane [Moeller and Trumbore 1997, "Fast, Minimum
    /// Storage Ray/Triangle Intersection"].
    [[gnu::always_inline]] inline void hit(const Ray& ray, TriangleHit& at) const
    {
        const float determinant = twice_area * dot(ng, ray.direction);
        const Vec3 moment = cross(ray.origin - corner, ray.direction);
        const float scale = determinant == 0.0f ? 0.0f : 1.0f / determinant;  // edge-on
        at.barycentrics = {-dot(moment, to_c) * scale, dot(moment, to_b) * scale};
        at.ng = ng;
        at.point = point(at.barycentrics);
    }
};

static_assert(sizeof(StillTriangle) == 64);

}  // namespace bdpt
