#pragma once

#include <bdpt/types.h>

#include <glm/geometric.hpp>

#include <array>
#include <cmath>

namespace bdpt {

/// Right-handed orthonormal basis. Always inlined: callers that need one coordinate compute one.
struct Frame {
    Vec3 x{1.0f, 0.0f, 0.0f};
    Vec3 y{0.0f, 1.0f, 0.0f};
    Vec3 z{0.0f, 0.0f, 1.0f};

    /// Returns a basis whose z axis is the unit vector `n` [Duff et al. 2017, "Building an
    /// Orthonormal Basis, Revisited"].
    [[nodiscard, gnu::always_inline]] static inline Frame from_normal(Vec3 n)
    {
        const float sign = std::copysign(1.0f, n.z);
        const float a = -1.0f / (sign + n.z);
        const float b = n.x * n.y * a;
        return {{1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x},
                {b, sign + n.y * n.y * a, -n.y},
                n};
    }

    [[nodiscard, gnu::always_inline]] inline Vec3 to_local(const Vec3& v) const
    {
        return {dot(v, x), dot(v, y), dot(v, z)};
    }
    [[nodiscard, gnu::always_inline]] inline Vec3 to_world(const Vec3& v) const
    {
        return v.x * x + v.y * y + v.z * z;
    }
};

/// Width of a pixel at a point, as seen directly from the camera, ignoring occlusion: a function of
/// the point and the camera alone, so that all walks through a point agree.
struct PixelCone {
    Vec3 eye{0.0f};
    float width = 0.0f;   ///< width of a pixel at the eye [m]
    float spread = 0.0f;  ///< increase of the width per metre of distance

    /// Returns the width of a pixel at a point [m].
    [[nodiscard]] float width_at(Vec3 point) const noexcept
    {
        const Vec3 way = point - eye;
        return width + spread * std::sqrt(dot(way, way));
    }
};

/// Change of texture coordinates over the width of a pixel, in two perpendicular directions on the
/// surface.
struct UvSteps {
    Vec2 along{0.0f};
    Vec2 across{0.0f};
};

/// Footprint of a pixel in each set of texture coordinates.
using UvFootprint = std::array<UvSteps, 2>;

}  // namespace bdpt
