#include "options/groups/environment_arguments.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "options/arguments.h"

namespace bdpt::app {

void add_environment_options(CLI::App& command, EnvironmentWords& words, const char* group)
{
    command
        .add_option("--env-rotation", words.rotation,
                    "Turn the environment about the vertical axis, counter-clockwise as seen from "
                    "above: by 90, what was at -z comes to -x [degrees]")
        ->type_name("DEG")
        ->group(group);
    command
        .add_option("--env-intensity", words.intensity,
                    "Multiply the radiance of the environment by this")
        ->type_name("X")
        ->group(group);
}

EnvironmentChange understand(const EnvironmentWords& words)
{
    constexpr double turn = 360.0;
    constexpr double most = 1e6;
    EnvironmentChange result;
    if (words.rotation) {
        if (!(std::abs(*words.rotation) <= turn)) {
            reject("--env-rotation", fmt::format("{}", *words.rotation),
                   "degrees from -360 to 360");
        }
        result.rotation = *words.rotation;
    }
    if (words.intensity) {
        if (!(*words.intensity >= 0.0 && *words.intensity <= most)) {
            reject("--env-intensity", fmt::format("{}", *words.intensity),
                   "a factor from 0 to 1000000");
        }
        result.intensity = static_cast<float>(*words.intensity);
    }
    return result;
}

}  // namespace bdpt::app
