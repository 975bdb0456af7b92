#pragma once

#include <filesystem>
#include <vector>

#include "options/render_arguments.h"
#include "options/values/file_set.h"

namespace bdpt::app {

/// Where images go, images of strategies too.
[[nodiscard]] std::vector<std::filesystem::path> all_image_files(const RenderArguments& arguments);

/// Refuses, before anything is rendered, what could not be written. Returns all that will be.
/// Throws `Error`: usage for files that are named twice, are among `inputs` or have a type that we
/// do not write, output for places where nothing can be written.
[[nodiscard]] std::vector<std::filesystem::path> check_files(const RenderArguments& arguments,
                                                             const FileSet& inputs);

}  // namespace bdpt::app
