#pragma once

#include <bdpt/io/denoise.h>
#include <bdpt/io/part_file.h>
#include <bdpt/part/render_result.h>

#include <filesystem>
#include <span>
#include <vector>

#include "options/groups/display_arguments.h"
#include "options/part_arguments.h"
#include "plan/plan.h"

namespace bdpt::app {

/// Returns the display options of images of parts like `part`: parts without the environment behind
/// them get the backdrop of their render, or that of `asked`. Throws `Error`
/// (invalid_input) for a backdrop behind parts that show the environment.
[[nodiscard]] DisplayArguments display_of_parts(const io::PartInfo& part, DisplayArguments asked);

/// Checks that files can be written, like `check_outputs` and `check_strategy_files`, and that no
/// file of an image is a part of any.
void check_merged_files(std::span<const MergeArguments> images);

/// Throws `Error` (invalid_input) if strategy images are requested but `part` has none.
void check_strategies(const MergeArguments& arguments, const io::PartInfo& part);

/// Returns all files that are written.
[[nodiscard]] std::vector<std::filesystem::path> merged_files(const MergeArguments& arguments);

/// Writes `part` to the files of `arguments`, images by `display`, denoised if there is a denoiser.
/// Returns the files that are denoised. Throws `Error` (output).
std::vector<std::filesystem::path> write_merged_files(const MergeArguments& arguments,
                                                      const DisplayArguments& display,
                                                      const io::Denoiser* denoiser,
                                                      const RenderResult& part,
                                                      io::PartNotes notes);

/// Throws `Error` (output) if the plan makes `arguments` replace a file that is not an image
/// written by bdpt: plans are not trusted.
void check_planned_outputs(const MergeArguments& arguments, const Plan& plan);

}  // namespace bdpt::app
