#pragma once

#include <bdpt/image.h>
#include <bdpt/io/exr.h>
#include <bdpt/render.h>

#include <filesystem>
#include <span>

#include "options/groups/strategy_arguments.h"

namespace bdpt::app {

/// Refuses, before anything is rendered, files that could not be written: throws `Error` (usage)
/// when one is also one of `others`, (output) for a place where nothing can be written.
void check_strategy_files(const StrategyFiles& files,
                          std::span<const std::filesystem::path> others);

/// Writes the image with the layers of all strategies, and the contact sheet. `exposure` [EV] is
/// that of the image. Throws `Error` (output).
void write_strategy_files(const StrategyFiles& files, const Image& image,
                          const StrategyFilm& strategies, const io::ExrOptions& options,
                          float exposure);

}  // namespace bdpt::app
