#pragma once

#include <bdpt/render_options.h>

#include <optional>
#include <string>

namespace CLI {
class App;
}

namespace bdpt::app {

/// What words say about the ground under the scene, as they were given.
struct GroundWords {
    std::string ground = "none";
    std::optional<double> height;  // [m]
};

/// Describes --ground and --ground-height to the parser.
void add_ground_options(CLI::App& command, GroundWords& words, const char* group);

/// `options`, whose background is known, with what `words` say. Throws `OptionError`.
[[nodiscard]] RenderOptions with_ground(const GroundWords& words, RenderOptions options);

/// Throws `OptionError` where `word` is given for `option`, which a shadow on the ground cannot be
/// seen through: `options` are those of `with_ground`.
void check_beside_ground(const char* option, const std::optional<std::string>& word,
                         const RenderOptions& options);

}  // namespace bdpt::app
