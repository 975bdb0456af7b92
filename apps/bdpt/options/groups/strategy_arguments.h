#pragma once

#include <bdpt/render_options.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "options/part_arguments.h"

namespace CLI {
class App;
}

namespace bdpt::app {

/// Longest paths [edges] whose strategies get images, if the user does not choose.
constexpr int default_strategy_depth = 5;

/// What the words after `bdpt render` say about images of strategies, as they were given.
struct StrategyWords {
    std::optional<std::string> file;
    std::optional<int> depth;  // [edges]
};

/// Where images of strategies go: into files, or only into the part that is rendered.
struct StrategyFiles {
    std::filesystem::path layers;  ///< .exr; empty: no files
    std::filesystem::path sheet;   ///< .png of the same stem
    std::optional<int> depth{};    ///< longest paths [edges], if the user chose

    /// None, if there are no files.
    [[nodiscard]] std::vector<std::filesystem::path> both() const;
};

void add_strategy_options(CLI::App& command, StrategyWords& words);

/// Describes --strategies alone.
void add_strategy_file_option(CLI::App& command, std::optional<std::string>& file,
                              const char* description);

/// The files that `file`, the value of --strategies, names. Throws `OptionError`.
[[nodiscard]] StrategyFiles strategy_files(const std::string& file);

/// None when no images are asked for: by a file, or a depth for those in a part. `part` says
/// whether there is one. Throws `Error` (usage) that names the option and the value.
[[nodiscard]] std::optional<StrategyFiles> strategy_files(const StrategyWords& words,
                                                          const RenderOptions& options,
                                                          const PartWords& part);

}  // namespace bdpt::app
