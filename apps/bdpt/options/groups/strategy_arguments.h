#pragma once

#include <bdpt/render_options.h>

#include <filesystem>
#include <optional>
#include <vector>

#include "options/option_list.h"

namespace bdpt::app {

/// Longest paths [edges] whose strategies get images, if the user does not choose.
constexpr int default_strategy_depth = 5;

/// Where images of strategies go: into files, or only into the part that is rendered.
struct StrategyFiles {
    std::filesystem::path layers{};  ///< .exr; empty: no files
    std::filesystem::path sheet{};   ///< .png of the same stem
    std::optional<int> depth{};      ///< longest paths [edges], if the user chose

    /// Those beside the file `layers`.
    [[nodiscard]] static StrategyFiles named(const std::filesystem::path& layers);
    /// None, if there are no files.
    [[nodiscard]] std::vector<std::filesystem::path> both() const;
};

/// Adds --strategies and --strategy-depth.
void add_strategy_options(OptionList& options, StrategyFiles& strategies);

/// Adds --strategies alone.
void add_strategy_file_option(OptionList& options, StrategyFiles& strategies, std::string help);

/// `strategies` where they are asked for: by a file, or a depth for those in a part. Throws
/// `OptionError` where they have no place, or the integrator of `render` has none.
[[nodiscard]] std::optional<StrategyFiles> checked(const StrategyFiles& strategies,
                                                   const RenderOptions& render,
                                                   const OptionList& options);

}  // namespace bdpt::app
