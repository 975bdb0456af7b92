#pragma once

#include <bdpt/scene.h>

namespace bdpt {

/// Statistics of rays in all directions from a point, which distinguish the inside of a room from
/// the inside or the outside of an object.
struct VisibilityProbe {
    Vec3 p{0.0f};
    float front = 0.0f;    ///< fraction of directions that hit the front of a surface
    float shell = 0.0f;    ///< fraction that hits a front near the bounds of the scene
    float escaped = 0.0f;  ///< fraction that hits nothing
    /// Mean escaping direction; its length is close to 1 if they agree.
    Vec3 escape_direction{0.0f};
    float clearance = 0.0f;  ///< distance to the nearest surface [m]
};

[[nodiscard]] VisibilityProbe probe_visibility(const World& world, Vec3 p);

/// Returns the mean distance of the surfaces that a camera with that aspect ratio sees [m]; 0 if
/// something blocks the view right in front of the lens. A ray that leaves the scene counts as the
/// scene's size.
[[nodiscard]] float view_depth(const World& world, const CameraDesc& camera, float aspect);

/// What 64 diffuse paths from a camera meet.
struct ViewPilot {
    /// Median distance of the first surfaces [m]; a ray that leaves the scene counts as its size.
    float median_distance = 0.0f;
    /// How well light reaches what the camera sees, in [0, 1]: mean over the paths of 1 if the
    /// first surface faces the lamp and nothing is between them, 1/2 if only the second does, 1/4
    /// for the third. A path that leaves the scene meets light in the same way.
    float lit = 0.0f;
};

[[nodiscard]] ViewPilot pilot_view(const World& world, const CameraDesc& camera, float aspect,
                                   Vec3 lamp);

}  // namespace bdpt
