#pragma once

#include <bdpt/light_desc.h>

#include "options/groups/environment_arguments.h"

namespace bdpt::app {

/// Returns `light` rotated and scaled.
[[nodiscard]] EnvironmentLightDesc changed(EnvironmentLightDesc light,
                                           const EnvironmentChange& change);

}  // namespace bdpt::app
