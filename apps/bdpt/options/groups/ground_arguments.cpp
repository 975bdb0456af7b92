#include "options/groups/ground_arguments.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "options/arguments.h"
#include "options/values/value_checks.h"

namespace bdpt::app {

void add_ground_options(CLI::App& command, GroundWords& words, const char* group)
{
    command
        .add_option("--ground", words.ground,
                    "shadow: catch the shadow of the scene on a level ground that is not seen "
                    "itself, and is in no reflection. The shadow is black, and adds to the alpha "
                    "of --background, which has to be given; .exr also gets it as layer shadow.A. "
                    "none (default)")
        ->check(one_of({"shadow", "none"}))
        ->type_name("shadow|none")
        ->group(group);
    command
        .add_option("--ground-height", words.height,
                    "Height of that ground, along y [m]. Default: the lowest point of the scene, "
                    "in each frame")
        ->type_name("Y")
        ->group(group);
}

RenderOptions with_ground(const GroundWords& words, RenderOptions options)
{
    const bool shadow = words.ground == "shadow";
    if (words.height) {
        constexpr double most = 1e15;  // as far as rays reach
        const std::string height = fmt::format("{}", *words.height);
        if (!(std::abs(*words.height) <= most)) {
            reject("--ground-height", height, "a height in metres");
        }
        if (!shadow) {
            reject("--ground-height", height, "--ground shadow with it");
        }
        options.film.ground_height = static_cast<float>(*words.height);
    }
    if (shadow) {
        if (options.transport.background == Background::environment) {
            reject("--ground", words.ground,
                   "--background with it, as transparent or a colour: a shadow is on nothing else");
        }
        options.film.aovs.insert(Aov::shadow);
    }
    return options;
}

void check_beside_ground(const char* option, const std::optional<std::string>& word,
                         const RenderOptions& options)
{
    if (word && options.film.aovs.contains(Aov::shadow)) {
        reject(option, *word, "no --ground shadow beside it");
    }
}

}  // namespace bdpt::app
