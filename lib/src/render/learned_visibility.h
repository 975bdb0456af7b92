#pragma once

#include "light/environment/environment_visibility.h"

#include <bdpt/render_options.h>
#include <bdpt/scene_desc.h>

#include <memory>

namespace bdpt {

class World;

/// Returns the result of `learn_visibility` for the whole image of this camera, using the threads
/// that the options allow. `options` have been checked, and name an integrator.
[[nodiscard]] std::unique_ptr<const EnvironmentVisibility> learned_visibility(
    const World& world, const CameraDesc& camera, const RenderOptions& options);

}  // namespace bdpt
