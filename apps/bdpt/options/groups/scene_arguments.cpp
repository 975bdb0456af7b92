#include "options/groups/scene_arguments.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "options/arguments.h"
#include "terminal/memory_limit.h"

namespace bdpt::app {
namespace {

std::optional<io::Shutter> parse_shutter(std::string_view text)
{
    const std::size_t comma = text.find(',');
    const bool pair = comma != std::string_view::npos;
    const std::optional<double> open = pair ? parse_double(text.substr(0, comma)) : 0.0;
    const std::optional<double> close = parse_double(pair ? text.substr(comma + 1) : text);
    if (!open || !close || *close < *open) {
        return std::nullopt;
    }
    return io::Shutter{*open, *close};
}

}  // namespace

void add_scene_options(CLI::App& command, SceneWords& words, const std::string& group)
{
    command
        .add_option("--scene", words.scene, "Scene of the file. Default: the file's default scene")
        ->type_name("NAME|INDEX")
        ->group(group);
    command
        .add_option("--variant", words.variant,
                    "Material variant. Default: the materials of the meshes")
        ->type_name("NAME|INDEX")
        ->group(group);
    command
        .add_option(
            "--frame-time", words.frame_time,
            "Time of the animation to render [s]. Without this and --animation nothing is animated")
        ->type_name("SECONDS")
        ->group(group);
    command
        .add_option("--animation", words.animation,
                    "Animation for --frame-time, or all. Default: the first")
        ->type_name("NAME|INDEX|all")
        ->group(group);
    command
        .add_option("--shutter", words.shutter,
                    "Motion blur: seconds that the shutter is open after --frame-time, or "
                    "OPEN,CLOSE relative to it")
        ->type_name("SECONDS|OPEN,CLOSE")
        ->group(group);
    command
        .add_option("--max-memory", words.max_memory,
                    "Refuse scenes that need more memory than this, like 500M or 2G; a render "
                    "counts its film and layers, too. Default, and never more: what the machine "
                    "has free, the container is allowed and ulimit -v leaves")
        ->type_name("SIZE")
        ->group(group);
}

io::MemoryLimit memory_limit(const SceneWords& words)
{
    if (!words.max_memory) {
        return memory_limit(std::nullopt);
    }
    const std::optional<std::uint64_t> bytes = parse_bytes(*words.max_memory);
    if (!bytes) {
        reject("--max-memory", *words.max_memory, "a size like 500M or 2G");
    }
    return memory_limit(bytes);
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
    if (words.shutter) {
        options.shutter = parse_shutter(*words.shutter);
        if (!options.shutter) {
            reject("--shutter", *words.shutter,
                   "seconds that are not negative, or OPEN,CLOSE with OPEN not after CLOSE");
        }
    }
    options.limits.memory_bytes = memory_limit(words).bytes;
    return options;
}

}  // namespace bdpt::app
