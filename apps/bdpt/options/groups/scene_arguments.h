#pragma once

#include <bdpt/io/gltf.h>
#include <bdpt/io/memory_budget.h>

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace bdpt::app {

/// Which part of a file is meant, as words.
struct SceneWords {
    std::optional<std::string> scene;       // name or index
    std::optional<std::string> variant;     // name or index
    std::optional<std::string> animation;   // name, index or "all"
    std::optional<double> frame_time;       // [s]
    std::optional<std::string> shutter;     // "CLOSE" or "OPEN,CLOSE" [s]
    std::optional<std::string> max_memory;  // like "2G"
};

/// Describes --scene, --variant, --animation, --frame-time, --shutter and --max-memory to the
/// parser, in the
/// group `group` of the help text.
void add_scene_options(CLI::App& command, SceneWords& words, const std::string& group);

/// That of --max-memory or of the machine, whichever is less. Throws `OptionError`.
[[nodiscard]] io::MemoryLimit memory_limit(const SceneWords& words);

/// Throws `Error` (usage) that names the option and the value.
[[nodiscard]] io::GltfOptions to_gltf_options(const SceneWords& words);

}  // namespace bdpt::app
