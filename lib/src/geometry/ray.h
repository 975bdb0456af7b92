#pragma once

#include <bdpt/types.h>

#include <cstdint>
#include <limits>

namespace bdpt {

struct Ray {
    Vec3 origin{0.0f};
    Vec3 direction{0.0f, 0.0f, 1.0f};  ///< any length; t is measured in it
    float t_max = std::numeric_limits<float>::infinity();
};

/// Where a ray met a triangle.
struct RayHit {
    std::uint32_t instance = 0;
    std::uint32_t triangle = 0;
    Vec2 barycentrics{0.0f};  ///< of the second and third corner
    Vec3 normal{0.0f};        ///< geometric, on the front side, in world space, any length
};

}  // namespace bdpt
