#pragma once

#include "light/environment/environment_visibility.h"

#include <bdpt/render_options.h>

#include <memory>
#include <stop_token>

namespace bdpt {

class MovingCamera;
class World;

/// Traces camera paths all over the image and records from where rays reach the environment.
/// Returns null if that would not help: without an environment, in fog, where nearly all of it is
/// visible everywhere, and unless the options request it (`EnvironmentSampling::learned`); also
/// once `abandon` is requested. A pure function of scene, camera, size of the film and transport
/// options: independent of seed, samples, crop and threads. `camera` is that of the whole image.
[[nodiscard]] std::unique_ptr<const EnvironmentVisibility> learn_visibility(
    const World& world, const MovingCamera& camera, const RenderOptions& options,
    const std::stop_token& abandon = {});

}  // namespace bdpt
