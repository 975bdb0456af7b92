#pragma once

/// @file
/// Lights a scene that comes without light.
///
/// @code{.cpp}
/// bdpt::io::LoadedScene file = bdpt::io::load_gltf("model.glb");
/// if (bdpt::add_default_lights(file.scene) != bdpt::DefaultLights::none) {
///     std::cerr << "model.glb has no light, so the default lights shine\n";
/// }
/// const bdpt::Scene scene(std::move(file.scene));
/// @endcode

#include <bdpt/export.h>
#include <bdpt/framing.h>
#include <bdpt/scene.h>
#include <bdpt/scene_desc.h>

#include <vector>

namespace bdpt {

// For scenes without lights. `frame_scene` does the same for scenes without a camera.

/// Tests whether something in `desc` may emit: a light, or a placed emissive material.
[[nodiscard]] BDPT_EXPORT bool has_light(const SceneDesc& desc);

/// Tests whether something in `desc` can be seen: a triangle, or a light with a radius.
[[nodiscard]] BDPT_EXPORT bool has_surface(const SceneDesc& desc);

/// Returns a soft grey sky for rooms without lights: its radiance is 1 nit on average, lowest
/// below and behind, and highest at the upper left of an observer who faces the front (+z), so that
/// sides with different orientations differ.
[[nodiscard]] BDPT_EXPORT EnvironmentLightDesc default_environment();

/// Returns the light of objects without lights: a key light on the left of an observer who faces
/// the front (+z), a weaker rim light behind on the right, and a sky that is darker than white
/// objects. Its radiance is 1 nit on average.
[[nodiscard]] BDPT_EXPORT EnvironmentLightDesc object_environment();

/// Returns a point light for a room that the sky does not reach. A white diffuse surface that faces
/// it, at the distance from the light to the camera, has 1 nit.
[[nodiscard]] BDPT_EXPORT PointLightDesc default_lamp(const FramedView& view);

/// Default lights of a scene.
enum class DefaultLights {
    none,          ///< the scene has lights
    object,        ///< `object_environment`, as the view is not into a room
    sky,           ///< `default_environment`, as the view is into an open room
    sky_and_lamp,  ///< `default_environment` and `default_lamp`, as the view is in a closed room
};

/// Returns the view in which light is measured for `missing_lights`: that of `frame_scene` at 16:9,
/// so that the size of an image never changes its light.
[[nodiscard]] BDPT_EXPORT FramedView metered_view(const Scene& scene);

/// Returns the default lights that `scene`, built without them, needs; `framed` is its
/// `metered_view`. None if the scene has a light, or if its emissive materials illuminate it: in an
/// open scene if half of the framed surfaces receive at least 3 % of the light of a default sky,
/// in a closed room if the mean of `white_cards` is at least 0.1 % of the light of the lamp.
[[nodiscard]] BDPT_EXPORT DefaultLights missing_lights(const Scene& scene,
                                                       const FramedView& framed);

/// Returns the lights of `missing`, in the view that they were missing in.
[[nodiscard]] BDPT_EXPORT std::vector<LightDesc> default_lights(DefaultLights missing,
                                                                const FramedView& framed);

/// Adds `missing_lights` to a scene, which is built once to determine them; throws like `Scene`.
BDPT_EXPORT DefaultLights add_default_lights(SceneDesc& desc);

}  // namespace bdpt
