#pragma once

#include <bdpt/export.h>
#include <bdpt/framing.h>
#include <bdpt/scene_desc.h>

namespace bdpt {

// For scenes that come without light. `frame_scene` does the same for those without a camera.

/// True when something in `desc` may shine: a light, or a placed material that emits.
[[nodiscard]] BDPT_EXPORT bool has_light(const SceneDesc& desc);

/// True when something in `desc` can be seen: a triangle, or a light with a radius.
[[nodiscard]] BDPT_EXPORT bool has_surface(const SceneDesc& desc);

/// A soft grey sky for scenes without light: its radiance is 0.5 nit below, grows upwards from the
/// horizon, and is 1 nit on average.
[[nodiscard]] BDPT_EXPORT EnvironmentLightDesc default_environment();

/// A lamp for a room that the sky does not reach. At the distance from the lamp to the camera a
/// white diffuse surface that faces it has 1 nit.
[[nodiscard]] BDPT_EXPORT PointLightDesc default_lamp(const FramedView& view);

/// What `add_default_lights` has done.
enum class DefaultLights {
    none,          ///< something shines
    sky,           ///< `default_environment` was added
    sky_and_lamp,  ///< and `default_lamp`, as the view is in a closed room
};

/// Adds light to a scene that has none. Builds it once to see whether it is a closed room; throws
/// what `Scene` throws. `aspect`: of the view, as for `frame_scene`.
BDPT_EXPORT DefaultLights add_default_lights(SceneDesc& desc, float aspect = 1.0f);

}  // namespace bdpt
