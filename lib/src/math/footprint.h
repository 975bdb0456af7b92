#pragma once

#include <bdpt/types.h>

#include <glm/geometric.hpp>

#include <array>
#include <cmath>

namespace bdpt {

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
