#include "options/groups/fog_arguments.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>

#include "options/arguments.h"

namespace bdpt::app {
namespace {

/// One number for all channels, or three.
Rgb color_of(const char* option, const std::string& text, float most, const std::string& expected)
{
    const std::optional<float> grey = parse_float(text);
    const std::optional<Vec3> color = grey ? Vec3(*grey) : parse_vec3(text);
    for (int channel = 0; channel < 3; ++channel) {
        if (!color || !((*color)[channel] >= 0.0f && (*color)[channel] <= most)) {
            reject(option, text, expected);
        }
    }
    return *color;
}

}  // namespace

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
    constexpr float most_extinction = 1e6f;
    MediumDesc fog{.extinction = color_of("--fog", *words.extinction, most_extinction,
                                          "a number per metre from 0 to 1000000, or three")};
    if (words.albedo) {
        fog.albedo = color_of("--fog-albedo", *words.albedo, 1.0f, "a number in [0, 1], or three");
    }
    if (words.anisotropy) {
        constexpr auto most = static_cast<double>(most_anisotropy);
        if (!(*words.anisotropy >= -most && *words.anisotropy <= most)) {
            reject("--fog-anisotropy", fmt::format("{}", *words.anisotropy),
                   fmt::format("a number from {:.4f} to {:.4f}", -most, most));
        }
        fog.anisotropy = static_cast<float>(*words.anisotropy);
    }
    return fog;
}

}  // namespace bdpt::app
