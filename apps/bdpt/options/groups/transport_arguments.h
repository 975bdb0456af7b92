#pragma once

#include <bdpt/render_options.h>

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "options/groups/light_sampling_arguments.h"

namespace CLI {
class App;
}

namespace bdpt::app {

/// What the words after `bdpt render` say about the transport of light, as they were given.
struct TransportWords {
    std::string integrator{};  ///< empty: not named
    std::string heuristic = "power";
    LightSamplingWords light_sampling{};
    int max_depth = RenderOptions{}.transport.max_depth;
    std::optional<std::string> only{};
    std::optional<int> max_camera_depth{};
    std::optional<int> max_light_depth{};
    std::optional<double> light_paths{};
    std::optional<double> connections{};
    std::optional<double> merge_radius{};
    std::optional<double> merge_alpha{};
    std::optional<int> rr_start{};
    std::optional<std::string> disabled{};
};

/// "s2t1,s0t3": strategies that make a path, with at most 1001 vertices on either side.
[[nodiscard]] std::optional<std::vector<Strategy>> parse_strategies(std::string_view text);

/// --light-paths and --connections.
void add_light_path_options(CLI::App& command, TransportWords& words, const char* group);
/// --merge-radius, whose default is `standard`.
void add_merge_radius_option(CLI::App& command, TransportWords& words, const char* group,
                             double standard);
/// These and all others.
void add_transport_options(CLI::App& command, TransportWords& words);

/// `options` with what `words` say. Throws `Error` (usage) that names the option and the value.
[[nodiscard]] RenderOptions with_transport(const TransportWords& words, RenderOptions options);

/// The strategies that are left out, as --disable takes them: "s1t1,s0t4".
[[nodiscard]] std::string disabled_text(const RenderOptions& options);

/// The integrator and, if it has them, its light paths and connections, and strategies that are
/// left out: "bdpt --light-paths 0.5 --connections 1 --disable s1t1".
[[nodiscard]] std::string integrator_words(const RenderOptions& options);

/// The integrator's name; or, if it was chosen by auto, the words that choose the same by hand.
[[nodiscard]] std::string integrator_text(const RenderOptions& options, bool chosen);

/// The options as members of the settings that are written into images.
[[nodiscard]] nlohmann::ordered_json transport_json(const RenderOptions& options);

}  // namespace bdpt::app
