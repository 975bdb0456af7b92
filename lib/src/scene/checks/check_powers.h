#pragma once

#include "material/material.h"
#include "scene/light_set.h"

#include <bdpt/scene_desc.h>

#include <span>

namespace bdpt {

/// Throws `Error` (invalid_input) that names the first light whose power is more than
/// `greatest_light_power`. `materials` and `lights` are those of the valid description `desc`.
void check_powers(const SceneDesc& desc, std::span<const Material> materials,
                  const LightSet& lights);

}  // namespace bdpt
