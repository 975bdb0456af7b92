#pragma once

#include <bdpt/render_options.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

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

/// Where images of strategies go.
struct StrategyFiles {
    std::filesystem::path layers;  ///< .exr
    std::filesystem::path sheet;   ///< .png of the same stem
    std::optional<int> depth;      ///< longest paths [edges], if the user chose

    [[nodiscard]] std::vector<std::filesystem::path> both() const { return {layers, sheet}; }
};

void add_strategy_options(CLI::App& command, StrategyWords& words);

/// None when no images are asked for. Throws `Error` (usage) that names the option and the value.
[[nodiscard]] std::optional<StrategyFiles> strategy_files(const StrategyWords& words,
                                                          const RenderOptions& options);

}  // namespace bdpt::app
