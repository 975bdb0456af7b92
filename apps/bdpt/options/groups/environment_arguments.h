#pragma once

#include "options/option_list.h"

namespace bdpt::app {

/// Changes of a scene's environment, whatever its source.
struct EnvironmentChange {
    double rotation = 0.0;   ///< about +y, counter-clockwise as seen from above [deg]
    float intensity = 1.0f;  ///< factor of the radiance, >= 0

    [[nodiscard]] bool operator==(const EnvironmentChange&) const = default;
};

/// Adds --env-rotation and --env-intensity.
void add_environment_options(OptionList& options, EnvironmentChange& change);

}  // namespace bdpt::app
