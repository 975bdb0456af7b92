#pragma once

#include <bdpt/render_options.h>
#include <bdpt/scene_desc.h>

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "options/option_list.h"

namespace bdpt::job {

/// Paths to render: all, those with one bounce or less, or all others.
enum class PathsOnly : std::uint8_t { all, direct, indirect };

/// Parses "s2t1,s0t3": strategies that form a path, with at most 4097 vertices on either side.
[[nodiscard]] std::optional<std::vector<Strategy>> parse_strategies(std::string_view text);

/// Returns the value type of an option with strategies.
[[nodiscard]] ValueType<std::vector<Strategy>> strategies_type();

/// Adds the integrator and all options of light transport.
void add_transport_options(OptionList& options, RenderOptions& render, PathsOnly& only);

/// Returns `render` with the implied integrator if none was named, and with the depths of `only`.
/// Throws `OptionError` for options that the integrator does not have.
[[nodiscard]] RenderOptions with_transport(RenderOptions render, PathsOnly only,
                                           const OptionList& options);

/// Returns the disabled strategies as in --disable: "s1t1,s0t4".
[[nodiscard]] std::string disabled_text(const RenderOptions& options);

/// Returns the integrator and, if it has them, its light paths and connections, and the disabled
/// strategies: "bdpt --light-paths 0.5 --connections 1 --disable s1t1".
[[nodiscard]] std::string integrator_words(const RenderOptions& options);

/// Returns the integrator's name; or, if auto chose it, the choice, for people.
[[nodiscard]] std::string integrator_text(const RenderOptions& options, bool chosen);

/// Returns the options as members of the settings that are written into images.
[[nodiscard]] nlohmann::ordered_json transport_json(const RenderOptions& options);

/// Default maximum path length [edges] of strategy images.
constexpr int default_strategy_depth = 5;

/// Destination of strategy images: files, or only the part that is rendered.
struct StrategyFiles {
    std::filesystem::path layers{};  ///< .exr; empty: no files
    std::optional<int> depth{};      ///< maximum path length [edges], if the user chose one

    /// Returns the .png file with the same stem.
    [[nodiscard]] std::filesystem::path sheet() const
    {
        return std::filesystem::path(layers).replace_extension(".png");
    }
    /// Returns both files; none if there are no files.
    [[nodiscard]] std::vector<std::filesystem::path> both() const;
};

/// Adds --strategies and --strategy-depth.
void add_strategy_options(OptionList& options, StrategyFiles& strategies);

/// Adds --strategies alone.
void add_strategy_file_option(OptionList& options, StrategyFiles& strategies, std::string help);

/// Returns `strategies` if they are requested: by a file, or by a depth for those in a part. Throws
/// `OptionError` if they have no destination, or the integrator of `render` has none.
[[nodiscard]] std::optional<StrategyFiles> checked(const StrategyFiles& strategies,
                                                   const RenderOptions& render,
                                                   const OptionList& options);

/// Maximum path length of strategy images.
struct StrategyDepth {
    int edges = 0;
    std::optional<std::string> warning;  ///< that paths are shorter than by default
};

/// Returns the depth that the user chose, or else the default, reduced to what memory allows.
/// Throws `Error` (usage) if the chosen one needs too much memory, or if no strategy makes such
/// paths.
[[nodiscard]] StrategyDepth strategy_depth(const StrategyFiles& files, RenderOptions options,
                                           const CameraDesc& camera);

}  // namespace bdpt::job
