#pragma once

#include "material/material.h"
#include "scene/light_set.h"

#include <bdpt/shared_scene_desc.h>

#include <span>

namespace bdpt {

/// Throws `Error` (invalid_input) that names the first light whose power is more than
/// `max_light_power`. The other arguments are those of the valid description `desc`.
void check_powers(const SharedSceneDesc& desc, std::span<const MaterialId> material_ids,
                  std::span<const Material> materials, const LightSet& lights);

}  // namespace bdpt
