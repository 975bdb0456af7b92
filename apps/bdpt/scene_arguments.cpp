#include "scene_arguments.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>

#include "arguments.h"

namespace bdpt::app {

void add_scene_options(CLI::App& command, SceneWords& words, const std::string& group)
{
    command.add_option("--scene", words.scene, "Scene of the file; the default one if not given")
        ->type_name("NAME|INDEX")
        ->group(group);
    command
        .add_option("--variant", words.variant,
                    "Variant of the materials; those of the meshes if not given")
        ->type_name("NAME|INDEX")
        ->group(group);
    command
        .add_option("--frame-time", words.frame_time,
                    "Moment of the animation to show, in its seconds. Nothing is animated if "
                    "neither this nor --animation is given")
        ->type_name("SECONDS")
        ->group(group);
    command
        .add_option("--animation", words.animation,
                    "Animation that --frame-time is about, or all. The first one if not given")
        ->type_name("NAME|INDEX|all")
        ->group(group);
    command
        .add_option("--max-memory", words.max_memory,
                    "Refuse scenes that need more memory, like 500M or 2G, before they take it; "
                    "bdpt info --limits tells the limits if not given")
        ->type_name("SIZE")
        ->group(group);
}

io::GltfOptions to_gltf_options(const SceneWords& words)
{
    if (words.frame_time && !std::isfinite(*words.frame_time)) {
        reject("--frame-time", fmt::format("{}", *words.frame_time), "a finite number of seconds");
    }
    io::GltfOptions options;
    options.scene = words.scene;
    options.variant = words.variant;
    options.animation = words.animation;
    options.time = words.frame_time;
    if (words.max_memory) {
        const std::optional<std::uint64_t> bytes = parse_bytes(*words.max_memory);
        if (!bytes) {
            reject("--max-memory", *words.max_memory, "a size like 500M or 2G");
        }
        options.limits = io::limits_within(*bytes);
    }
    return options;
}

}  // namespace bdpt::app
