#pragma once

#include "light/learned/learned_light.h"

#include <bdpt/render_options.h>

#include <memory>
#include <stop_token>

namespace bdpt {

class MovingCamera;
class World;

/// Tests whether learning can help this render: it needs an environment, several groups of lights,
/// or light paths and a sun or several lamps; no fog, an integrator with other techniques that find
/// rare light, and options that request it (`EnvironmentSampling::learned`).
[[nodiscard]] bool can_learn_light(const World& world, const RenderOptions& options);

/// Traces camera paths all over the image and records the contributions of light samples at their
/// vertices, the lights that they hit, and from where rays reach the environment and suns. Returns
/// null if that does not help: unless `can_learn_light`, and if nearly all of a single environment
/// is visible everywhere; also once `abandon` is requested. A pure function of scene, camera, size
/// of the film and transport options: independent of seed, samples, crop and threads. `camera` is
/// that of the whole image.
[[nodiscard]] std::unique_ptr<const LearnedLight> learn_light(const World& world,
                                                              const MovingCamera& camera,
                                                              const RenderOptions& options,
                                                              const std::stop_token& abandon = {});

}  // namespace bdpt
