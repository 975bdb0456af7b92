#pragma once

#include <filesystem>
#include <vector>

#include "options/render_arguments.h"
#include "stage/prepared_scene.h"

namespace bdpt::app {

/// All files that `arguments` name to be read: no output may be one of them.
[[nodiscard]] std::vector<std::filesystem::path> input_files(const RenderArguments& arguments);

/// These, and those that the scene names.
[[nodiscard]] std::vector<std::filesystem::path> input_files(const RenderArguments& arguments,
                                                             const PreparedScene& stage);

}  // namespace bdpt::app
