#pragma once

#include "scene/scene_geometry.h"

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

}  // namespace bdpt
