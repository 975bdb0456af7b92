#pragma once

#include <bdpt/export.h>
#include <bdpt/scene.h>

#include <optional>

namespace bdpt {

/// Where a camera stands, as seen from what it looks at [rad].
struct ViewDirection {
    float azimuth = 0.0f;    ///< 0: towards +z, the front of glTF; pi/2: towards +x
    float elevation = 0.0f;  ///< in [-pi/2, pi/2]; above the horizon if positive
};

/// The view that most objects are shown from: 35 degrees to the right, and 20 above.
inline constexpr ViewDirection three_quarter_view{.azimuth = 0.6108652f, .elevation = 0.3490659f};

/// How `frame_scene` frames.
struct FrameOptions {
    /// From outside, whatever the scene is. None: three quarters from the front and slightly above
    /// for an object, nearly from its flat side for one like a board, from 45 degrees above for one
    /// like a floor, from its long side for a row; from inside for a room.
    std::optional<ViewDirection> direction{};
    /// From outside: share of the width and of the height that stays free on each side of the
    /// image, in [0, 0.5). None: 0.1, so that the scene fills 80 % of the width or of the height;
    /// less around a room that lacks a wall.
    std::optional<float> margin{};
    /// [rad], in (0, pi). None: 40 degrees from outside, 60 from inside.
    std::optional<float> vertical_fov{};
    /// Orthographic: from outside, whatever the scene is.
    Projection projection = Projection::perspective;
    /// Keep the margin in all views of a turntable (`orbited`) around the middle of the bounds.
    bool whole_turn = false;
};

/// A view for a scene that came without a camera.
struct FramedView {
    CameraDesc camera;
    /// The view stands in a space that hardly any ray leaves, so that light from infinity would not
    /// reach it.
    bool enclosed = false;
    /// A point in free space well above the camera's target, where a lamp lights what is seen.
    Vec3 lamp_position{0.0f};
};

/// Frames a whole scene. From outside, the camera is as near as the margin allows, by the corners
/// of all triangles. Deterministic. `aspect` is width over height, above 0. With a direction or an
/// orthographic projection, `enclosed` is false.
[[nodiscard]] BDPT_EXPORT FramedView frame_scene(const Scene& scene, float aspect,
                                                 const FrameOptions& options = {});

/// `camera` after it went `angle` [rad] around the vertical axis through `center`,
/// counter-clockwise as seen from above, with all its motion: a view of a turntable. The same bits
/// on all machines.
[[nodiscard]] BDPT_EXPORT CameraDesc orbited(CameraDesc camera, Vec3 center, float angle);

/// `environment` turned by `angle` [rad] around the vertical axis, counter-clockwise as seen from
/// above. The same bits on all machines.
[[nodiscard]] BDPT_EXPORT EnvironmentLightDesc turned(EnvironmentLightDesc environment,
                                                      float angle);

}  // namespace bdpt
