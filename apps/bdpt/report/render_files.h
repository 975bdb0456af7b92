#pragma once

#include <filesystem>
#include <vector>

#include "options/render_arguments.h"
#include "options/values/file_set.h"

namespace bdpt::app {

/// Returns all files of images, strategy images included.
[[nodiscard]] std::vector<std::filesystem::path> all_image_files(const RenderArguments& arguments);

/// Throws `Error` if the job of `arguments`, whose author may be a stranger, names files to write:
/// invalid_input for those that are not in its folder or below, output for those that exist and
/// were not written by bdpt.
void check_files_of_job(const RenderArguments& arguments);

/// Checks, before anything is rendered, that files can be written, and returns all of them. Throws
/// `Error`: usage for files that are named twice, are among `inputs` or have a type that bdpt does
/// not write, output for places where nothing can be written.
[[nodiscard]] std::vector<std::filesystem::path> check_files(const RenderArguments& arguments,
                                                             const FileSet& inputs);

}  // namespace bdpt::app
