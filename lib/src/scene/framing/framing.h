#pragma once

#include "scene/scene_geometry.h"

#include <bdpt/scene.h>
#include <bdpt/scene_desc.h>

namespace bdpt {

/// Image that a scene is fitted into.
struct FitTarget {
    float aspect = 1.0f;  ///< width over height
    /// Fraction of the width and of the height that stays free on each side, in [0, 0.5).
    float margin = 0.0f;
    /// Perspective or orthographic camera with its field of view; the other members are ignored.
    CameraDesc camera{};
    /// Fits all views of a camera that orbits the vertical axis through the centre of the bounds.
    bool whole_turn = false;
};

/// Returns the closest camera with these axes (columns: right, up, back; unit) that sees all
/// surfaces of the scene: on two opposite sides of the image, only the margin stays free. Exact for
/// perspective, too: each side of the frustum is a plane that touches the scene at its support
/// point along the plane's normal.
[[nodiscard]] CameraDesc fitted_camera(const SceneGeometry& geometry, const Mat3& axes,
                                       const FitTarget& target);

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
