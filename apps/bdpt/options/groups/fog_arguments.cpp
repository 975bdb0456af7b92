#include "options/groups/fog_arguments.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>

#include "options/arguments.h"
#include "options/values/medium_values.h"

namespace bdpt::app {

void add_fog_options(CLI::App& command, FogWords& words, const char* group)
{
    command
        .add_option("--fog", words.extinction,
                    "Fill the scene, but for its bodies, with a medium that scatters and absorbs: "
                    "its extinction, which is one over the mean free path [1/m]")
        ->type_name("X|R,G,B")
        ->group(group);
    command
        .add_option("--fog-albedo", words.albedo,
                    "How much of what the fog takes away it scatters, from 0 to 1. Default: 1")
        ->type_name("X|R,G,B")
        ->group(group);
    command
        .add_option("--fog-anisotropy", words.anisotropy,
                    "Where the fog scatters to, between -1 and 1: > 0 forwards, as mist does. "
                    "Default: 0, everywhere alike")
        ->type_name("G")
        ->group(group);
}

std::optional<MediumDesc> understand(const FogWords& words)
{
    if (!words.extinction) {
        if (words.albedo) {
            reject("--fog-albedo", *words.albedo, "--fog with it");
        }
        if (words.anisotropy) {
            reject("--fog-anisotropy", fmt::format("{}", *words.anisotropy), "--fog with it");
        }
        return std::nullopt;
    }
    MediumDesc fog{.extinction = color_of("--fog", *words.extinction, most_extinction,
                                          "a number per metre from 0 to 1000000, or three")};
    if (words.albedo) {
        fog.albedo = albedo_of("--fog-albedo", *words.albedo);
    }
    if (words.anisotropy) {
        fog.anisotropy = anisotropy_of("--fog-anisotropy", *words.anisotropy);
    }
    return fog;
}

}  // namespace bdpt::app
