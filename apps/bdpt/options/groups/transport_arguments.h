#pragma once

#include <bdpt/render_options.h>

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "options/option_list.h"

namespace bdpt::app {

/// Which paths are wanted: all, those with one bounce or less, or all others.
enum class PathsOnly : std::uint8_t { all, direct, indirect };

/// "s2t1,s0t3": strategies that make a path, with at most 4097 vertices on either side.
[[nodiscard]] std::optional<std::vector<Strategy>> parse_strategies(std::string_view text);

/// These as the value of an option.
[[nodiscard]] ValueType<std::vector<Strategy>> strategies_type();

/// Adds the integrator and all that says how it transports light.
void add_transport_options(OptionList& options, RenderOptions& render, PathsOnly& only);

/// `render` with the integrator that was meant if none was named, and with the depths of `only`.
/// Throws `OptionError` for options that the integrator does not take.
[[nodiscard]] RenderOptions with_transport(RenderOptions render, PathsOnly only,
                                           const OptionList& options);

/// The strategies that are left out, as --disable takes them: "s1t1,s0t4".
[[nodiscard]] std::string disabled_text(const RenderOptions& options);

/// The integrator and, if it has them, its light paths and connections, and strategies that are
/// left out: "bdpt --light-paths 0.5 --connections 1 --disable s1t1".
[[nodiscard]] std::string integrator_words(const RenderOptions& options);

/// The integrator's name; or, if it was chosen by auto, what that chose, for people.
[[nodiscard]] std::string integrator_text(const RenderOptions& options, bool chosen);

/// The options as members of the settings that are written into images.
[[nodiscard]] nlohmann::ordered_json transport_json(const RenderOptions& options);

}  // namespace bdpt::app
