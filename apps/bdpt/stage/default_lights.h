#pragma once

#include <bdpt/framing.h>
#include <bdpt/scene_desc.h>

namespace bdpt::app {

/// True when something in `desc` may shine: a light, or a placed material that emits.
[[nodiscard]] bool has_light(const SceneDesc& desc);

/// True when something in `desc` can be seen: a triangle, or a light with a radius.
[[nodiscard]] bool has_surface(const SceneDesc& desc);

/// A soft grey sky for scenes without light: its radiance is 0.5 nit below, grows upwards from the
/// horizon, and is 1 nit on average.
[[nodiscard]] EnvironmentLightDesc default_environment();

/// A lamp for a room that the sky does not reach. At the distance from the lamp to the camera a
/// white diffuse surface that faces it has 1 nit.
[[nodiscard]] PointLightDesc default_lamp(const FramedView& view);

}  // namespace bdpt::app
