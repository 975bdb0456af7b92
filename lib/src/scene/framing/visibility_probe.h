#pragma once

#include <bdpt/scene.h>

namespace bdpt {

/// What rays in all directions find from a point: enough to tell the inside of a room from the
/// inside or the outside of an object.
struct VisibilityProbe {
    Vec3 p{0.0f};
    float front = 0.0f;           ///< share of directions that meet the front of a surface
    float shell = 0.0f;           ///< share that meet a front near the bounds of the scene
    float escaped = 0.0f;         ///< share that meet nothing
    Vec3 escape_direction{0.0f};  ///< mean of those; its length says how much they agree
    float clearance = 0.0f;       ///< distance to the nearest surface [m]
};

[[nodiscard]] VisibilityProbe probe_visibility(const World& world, Vec3 p);

/// Mean distance [m] to what a camera of that aspect sees; 0 when something stands in the way right
/// before the lens. A ray that leaves the scene counts as its size.
[[nodiscard]] float view_depth(const World& world, const CameraDesc& camera, float aspect);

}  // namespace bdpt
