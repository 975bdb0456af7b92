#pragma once

#include <bdpt/image.h>
#include <bdpt/io/exr.h>
#include <bdpt/render.h>

#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "options/strategy_arguments.h"

namespace bdpt::app {

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

/// Writes the image with the layers of all strategies, and the contact sheet. `exposure` [EV] is
/// that of the image. Throws `Error` (output).
void write_strategy_files(const StrategyFiles& files, const Image& image,
                          const StrategyFilm& strategies, const io::ExrOptions& options,
                          float exposure);

}  // namespace bdpt::app
