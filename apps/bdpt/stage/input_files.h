#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "options/render_arguments.h"
#include "stage/prepared_scene.h"

namespace bdpt::app {

/// Returns all files that `arguments` read: no output may be one of them.
[[nodiscard]] std::vector<std::filesystem::path> input_files(const RenderArguments& arguments);

/// Returns all files that `arguments` and the scene read.
[[nodiscard]] std::vector<std::filesystem::path> input_files(const RenderArguments& arguments,
                                                             const PreparedScene& stage);

/// Returns the files that the scene names, by its text alone: for outputs that are written before
/// it is loaded. Empty if none of `outputs` exists, as none can then be one of them, or if the
/// scene cannot be read.
[[nodiscard]] std::vector<std::filesystem::path> named_files(
    const RenderArguments& arguments, std::span<const std::filesystem::path> outputs);

}  // namespace bdpt::app
