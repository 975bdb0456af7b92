#pragma once

#include <bdpt/export.h>
#include <bdpt/framing.h>
#include <bdpt/scene.h>
#include <bdpt/scene_desc.h>

namespace bdpt {

// For scenes that come without light. `frame_scene` does the same for those without a camera.

/// True when something in `desc` may shine: a light, or a placed material that emits.
[[nodiscard]] BDPT_EXPORT bool has_light(const SceneDesc& desc);

/// True when something in `desc` can be seen: a triangle, or a light with a radius.
[[nodiscard]] BDPT_EXPORT bool has_surface(const SceneDesc& desc);

/// A soft grey sky for scenes without light: its radiance is 1 nit on average, least below and
/// behind, and greatest high on the left of who sees the front (+z), so that sides that face
/// different ways differ.
[[nodiscard]] BDPT_EXPORT EnvironmentLightDesc default_environment();

/// A lamp for a room that the sky does not reach. At the distance from the lamp to the camera a
/// white diffuse surface that faces it has 1 nit.
[[nodiscard]] BDPT_EXPORT PointLightDesc default_lamp(const FramedView& view);

/// Lights by default.
enum class DefaultLights {
    none,          ///< the scene has light
    sky,           ///< `default_environment`
    sky_and_lamp,  ///< and `default_lamp`, as the view is in a closed room
};

/// The default lights that `scene`, which has been built without them, needs; `framed` is the
/// result of `frame_scene` and `aspect`. None if the scene has a light, or if its emissive
/// materials light it: in an open scene if half of the framed surfaces get at least 3 % of the
/// light of the default sky, in a closed room if the mean of `white_cards` is at least 0.1 % of the
/// light of the lamp.
[[nodiscard]] BDPT_EXPORT DefaultLights missing_lights(const Scene& scene, const FramedView& framed,
                                                       float aspect = 1.0f);

/// Adds `missing_lights` to a scene, which is built once to find them; throws what `Scene` throws.
/// `aspect`: of the view, as for `frame_scene`.
BDPT_EXPORT DefaultLights add_default_lights(SceneDesc& desc, float aspect = 1.0f);

}  // namespace bdpt
