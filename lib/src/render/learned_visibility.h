#pragma once

#include "light/environment/environment_visibility.h"

#include <bdpt/render_options.h>
#include <bdpt/scene_desc.h>

#include <memory>

namespace bdpt {

class World;

/// What `learn_visibility` finds for the whole image of this camera, by the threads that the
/// options allow. `options` have been checked, and name an integrator.
[[nodiscard]] std::unique_ptr<const EnvironmentVisibility> learned_visibility(
    const World& world, const CameraDesc& camera, const RenderOptions& options);

}  // namespace bdpt
