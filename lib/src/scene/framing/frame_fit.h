#pragma once

#include "scene/scene_geometry.h"

#include <bdpt/scene_desc.h>

namespace bdpt {

/// The image that a scene is fitted into.
struct FitTarget {
    float aspect = 1.0f;  ///< width over height
    /// Share of the width and of the height that stays free on each side, in [0, 0.5).
    float margin = 0.0f;
    /// Perspective or orthographic, with its field of view; the rest is not looked at.
    CameraDesc camera{};
    /// All views of a camera that goes around the vertical axis through the middle of the bounds.
    bool whole_turn = false;
};

/// The camera with these axes (columns: right, up, back; unit) that sees all surfaces of the scene
/// and is as near as that allows: on two opposite sides of the image, nothing but the margin stays
/// free. Exact for perspective, too: each side of the frustum is a plane, and the scene touches it
/// where its support in the direction of the plane's normal is.
[[nodiscard]] CameraDesc fitted_camera(const SceneGeometry& geometry, const Mat3& axes,
                                       const FitTarget& target);

}  // namespace bdpt
