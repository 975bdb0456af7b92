#pragma once

#include <bdpt/types.h>

#include <glm/geometric.hpp>

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

}  // namespace bdpt
