#pragma once

#include <bdpt/image.h>
#include <bdpt/io/exr.h>
#include <bdpt/render.h>

#include "options/groups/strategy_arguments.h"
#include "options/values/file_set.h"

namespace bdpt::app {

/// Checks, before anything is rendered, that files can be written. Throws `Error`: usage if one is
/// an input or one of `outputs`, output for a place where nothing can be written.
void check_strategy_files(const StrategyFiles& files, const FileSet& inputs,
                          const FileSet& outputs);

/// Writes the image with the layers of all strategies, and the contact sheet. `exposure` [EV] is
/// that of the image. Throws `Error` (output).
void write_strategy_files(const StrategyFiles& files, const Image& image,
                          const StrategyFilm& strategies, const io::ExrOptions& options,
                          float exposure);

}  // namespace bdpt::app
