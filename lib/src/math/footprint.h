#pragma once

#include <bdpt/types.h>

#include <glm/geometric.hpp>

#include <array>
#include <cmath>

namespace bdpt {

/// How wide a pixel is where a point is, seen straight from the camera, whatever lies between: a
/// function of the point and the camera alone, so that all walks that meet a point agree.
struct PixelCone {
    Vec3 eye{0.0f};
    float width = 0.0f;   ///< of a pixel at the eye [m]
    float spread = 0.0f;  ///< that it gains a metre of distance

    /// [m]
    [[nodiscard]] float width_at(Vec3 point) const noexcept
    {
        const Vec3 way = point - eye;
        return width + spread * std::sqrt(dot(way, way));
    }
};

/// How far texture coordinates go over the width of a pixel, in two directions at right angles on
/// the surface.
struct UvSteps {
    Vec2 along{0.0f};
    Vec2 across{0.0f};
};

/// What a pixel covers of each set of texture coordinates.
using UvFootprint = std::array<UvSteps, 2>;

}  // namespace bdpt
