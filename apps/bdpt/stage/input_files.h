#pragma once

#include <filesystem>
#include <vector>

#include "options/render_arguments.h"
#include "stage/prepared_scene.h"

namespace bdpt::app {

/// Returns all files that `arguments` read: no output may be one of them.
[[nodiscard]] std::vector<std::filesystem::path> input_files(const RenderArguments& arguments);

/// Returns all files that `arguments` and the scene read.
[[nodiscard]] std::vector<std::filesystem::path> input_files(const RenderArguments& arguments,
                                                             const PreparedScene& stage);

}  // namespace bdpt::app
