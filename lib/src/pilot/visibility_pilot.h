#pragma once

#include "light/environment/environment_visibility.h"

#include <bdpt/render_options.h>

#include <memory>
#include <stop_token>

namespace bdpt {

class MovingCamera;
class World;

/// Traces camera paths all over the image and notes from where rays reach the environment. Null
/// where that would not help: without an environment, in fog, where nearly all of it is visible
/// everywhere, and unless the options ask for it (`EnvironmentSampling::learned`). A pure function
/// of scene, camera, size of the film and options of transport: seed, samples, crop and threads
/// do not matter. `camera` is that of the whole image. Null too once `abandon` is requested.
[[nodiscard]] std::unique_ptr<const EnvironmentVisibility> learn_visibility(
    const World& world, const MovingCamera& camera, const RenderOptions& options,
    const std::stop_token& abandon = {});

}  // namespace bdpt
