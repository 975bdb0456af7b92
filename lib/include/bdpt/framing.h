#pragma once

/// @file
/// Finds a camera for a scene that has none, and moves cameras around scenes.
///
/// @code{.cpp}
/// void render_back(const bdpt::Scene& scene)
/// {
///     const auto front = bdpt::frame_scene(scene, 16.0f / 9.0f, {.whole_turn = true}).camera;
///     const bdpt::Vec3 center = 0.5f * (scene.bounds().min + scene.bounds().max);
///     const bdpt::CameraDesc back = bdpt::orbited(front, center, std::numbers::pi_v<float>);
///     const bdpt::RenderResult result = bdpt::render(scene, back, {});
///     bdpt::io::write_exr("back.exr", result.image(), {});
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/scene.h>

#include <optional>

namespace bdpt {

/// Direction from the camera's target to the camera [rad].
struct ViewDirection {
    float azimuth = 0.0f;    ///< 0: towards +z, the front of glTF; pi/2: towards +x
    float elevation = 0.0f;  ///< in [-pi/2, pi/2]; positive above the horizon
};

/// Returns the unit vector in that direction. Bit-identical on all machines.
[[nodiscard]] BDPT_EXPORT Vec3 unit_vector(const ViewDirection& direction);

/// The usual view of objects: from 35 degrees to the right, and 20 above.
inline constexpr ViewDirection three_quarter_view{.azimuth = 0.6108652f, .elevation = 0.3490659f};

/// Options of `frame_scene`.
struct FrameOptions {
    /// Views the scene from outside, from this direction. nullopt: three quarters from the front
    /// and slightly above for an object, nearly from its flat side for one like a board, from 45
    /// degrees above for one like a floor, from its long side for a row; from inside for a room.
    std::optional<ViewDirection> direction{};
    /// Views from outside: fraction of the width and of the height that stays free on each side of
    /// the image, in [0, 0.5). nullopt: 0.1, so that the scene fills 80 % of the width or of the
    /// height; less around a room that lacks a wall.
    std::optional<float> margin{};
    /// Vertical field of view [rad], in (0, pi). nullopt: 40 degrees from outside, 60 from inside.
    std::optional<float> vertical_fov{};
    /// Orthographic projection implies a view from outside.
    Projection projection = Projection::perspective;
    /// Keeps the margin in all views of a turntable (`orbited`) around the centre of the bounds.
    bool whole_turn = false;
};

/// A view for a scene without a camera.
struct FramedView {
    CameraDesc camera;
    /// True if the view is from the inside of a closed room: of 32 pairs of an eye and a lamp, the
    /// one whose picture is deep and lit, as a pilot of 64 paths each sees it. The choice does not
    /// depend on the aspect ratio and the field of view.
    bool inside = false;
    /// True if the view is from inside, or into a room that lacks a wall; false for an object.
    bool room = false;
    /// True if hardly any ray leaves the space around the camera, so that light from infinity would
    /// not reach it.
    bool enclosed = false;
    /// A point in free space, where a point light illuminates the view: well above the camera's
    /// target, or in a closed room that of the pair.
    Vec3 lamp_position{0.0f};
};

/// Frames a whole scene. From outside, the camera is as close as the margin allows, by the corners
/// of all triangles. Deterministic. `aspect` is width over height, above 0. With a direction or an
/// orthographic projection, `enclosed` is false.
[[nodiscard]] BDPT_EXPORT FramedView frame_scene(const Scene& scene, float aspect,
                                                 const FrameOptions& options = {});

/// Returns `camera` rotated by `angle` [rad] around the vertical axis through `center`,
/// counter-clockwise as seen from above, including its motion: a view of a turntable. Bit-identical
/// on all machines.
[[nodiscard]] BDPT_EXPORT CameraDesc orbited(CameraDesc camera, Vec3 center, float angle);

/// Returns `environment` rotated by `angle` [rad] around the vertical axis, counter-clockwise as
/// seen from above. Bit-identical on all machines.
[[nodiscard]] BDPT_EXPORT EnvironmentLightDesc turned(EnvironmentLightDesc environment,
                                                      float angle);

}  // namespace bdpt
