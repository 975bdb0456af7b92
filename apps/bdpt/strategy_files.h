#pragma once

#include <bdpt/render.h>

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pictures.h"

namespace CLI {
class App;
}

namespace bdpt::app {

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

/// Refuses, before anything is rendered, files that could not be written: throws `Error` (usage)
/// when one is also one of `others`, (output) for a place where nothing can be written.
void check_strategy_files(const StrategyFiles& files,
                          std::span<const std::filesystem::path> others);

/// How long the paths are whose strategies get images.
struct StrategyDepth {
    int edges = 0;
    std::optional<std::string> warning;  ///< that they are shorter than they would be
};

/// The depth that the user chose, or the default one or as much of it as memory is allowed for.
/// Throws `Error` (usage) when that is too much, or when no strategy makes such paths.
[[nodiscard]] StrategyDepth strategy_depth(const StrategyFiles& files, RenderOptions options,
                                           const CameraDesc& camera);

/// Writes the picture with the layers of all strategies, and the contact sheet. `exposure` [EV] is
/// that of the picture. Throws `Error` (output).
void write_strategy_files(const StrategyFiles& files, const Image& image,
                          const StrategyFilm& strategies, const io::ExrOptions& options,
                          float exposure);

}  // namespace bdpt::app
