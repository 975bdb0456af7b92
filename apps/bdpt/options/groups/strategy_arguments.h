#pragma once

#include <bdpt/render_options.h>

#include <filesystem>
#include <optional>
#include <vector>

#include "options/option_list.h"

namespace bdpt::app {

/// Default maximum path length [edges] of strategy images.
constexpr int default_strategy_depth = 5;

/// Destination of strategy images: files, or only the part that is rendered.
struct StrategyFiles {
    std::filesystem::path layers{};  ///< .exr; empty: no files
    std::filesystem::path sheet{};   ///< .png file with the same stem
    std::optional<int> depth{};      ///< maximum path length [edges], if the user chose one

    /// Returns the files beside the file `layers`.
    [[nodiscard]] static StrategyFiles named(const std::filesystem::path& layers);
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

}  // namespace bdpt::app
