#pragma once

#include <bdpt/export.h>
#include <bdpt/scene.h>

namespace bdpt {

/// A view for a scene that came without a camera.
struct FramedView {
    CameraDesc camera;
    /// The view stands in a space that hardly any ray leaves, so that light from infinity would not
    /// reach it.
    bool enclosed = false;
    /// A point in free space well above the camera's target, where a lamp lights what is seen.
    Vec3 lamp_position{0.0f};
};

/// Frames a whole scene: from outside, three quarters and slightly above, if it is an object; from
/// inside if it is a room. Deterministic. `aspect` is width over height, above 0.
[[nodiscard]] BDPT_EXPORT FramedView frame_scene(const Scene& scene, float aspect);

/// `camera` after it went `angle` [rad] around the vertical axis through `center`,
/// counter-clockwise as seen from above, with all its motion: a view of a turntable. The same bits
/// on all machines.
[[nodiscard]] BDPT_EXPORT CameraDesc orbited(CameraDesc camera, Vec3 center, float angle);

/// `environment` turned by `angle` [rad] around the vertical axis, counter-clockwise as seen from
/// above. The same bits on all machines.
[[nodiscard]] BDPT_EXPORT EnvironmentLightDesc turned(EnvironmentLightDesc environment,
                                                      float angle);

}  // namespace bdpt
