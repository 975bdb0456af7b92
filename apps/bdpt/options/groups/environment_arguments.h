#pragma once

#include "options/option_list.h"

namespace bdpt::app {

/// What is changed in the environment of a scene, wherever it comes from.
struct EnvironmentChange {
    double rotation = 0.0;   ///< [deg] about +y, counter-clockwise as seen from above
    float intensity = 1.0f;  ///< >= 0, times the radiance

    [[nodiscard]] bool operator==(const EnvironmentChange&) const = default;
};

/// Adds --env-rotation and --env-intensity.
void add_environment_options(OptionList& options, EnvironmentChange& change);

}  // namespace bdpt::app
