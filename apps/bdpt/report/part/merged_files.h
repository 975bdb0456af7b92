#pragma once

#include <bdpt/io/image_metadata.h>
#include <bdpt/io/part_file.h>
#include <bdpt/part/render_part.h>

#include "options/groups/display_arguments.h"
#include "options/part_arguments.h"

namespace bdpt::app {

/// How images of parts are shown: parts without the environment behind them get the backdrop that
/// was asked for when they were rendered, or that of `asked`. Throws `Error` (invalid_input) for a
/// backdrop behind parts that show the environment.
[[nodiscard]] DisplayArguments display_of_parts(const io::ImageMetadata& metadata,
                                                DisplayArguments asked);

/// Writes `part` to the outputs of `arguments`, images as `display` says. Throws `Error` (output).
void write_merged_files(const MergeArguments& arguments, const DisplayArguments& display,
                        const RenderPart& part, io::PartNotes notes);

}  // namespace bdpt::app
