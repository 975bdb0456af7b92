#pragma once

#include "light/learned/learned_light.h"

#include <bdpt/render_options.h>
#include <bdpt/scene_desc.h>

#include <memory>
#include <stop_token>

namespace bdpt {

class World;

/// Returns the result of `learn_light` for the whole image of this camera, using the threads that
/// the options allow. `options` have been checked, and name an integrator. The world remembers the
/// result, so that all renders of the same view learn once; null, and not remembered, once
/// `abandon` is requested.
[[nodiscard]] std::shared_ptr<const LearnedLight> learned_light(
    const World& world, const CameraDesc& camera, const RenderOptions& options,
    const std::stop_token& abandon = {});

}  // namespace bdpt
