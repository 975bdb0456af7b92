#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "plan/plan.h"

namespace bdpt::app {

// Files in the folder of a plan: all that bdpt writes there, and all that `bdpt plan --restart`
// removes. A plan that names others was not written by bdpt.

inline constexpr const char* plan_name = "plan.json";
inline constexpr const char* rates_name = "rates.exr";

/// Returns the name of the part of task `task` of `count`: with #### and {camera} if images like
/// `image` have a frame and a camera.
[[nodiscard]] std::string part_name(const PlanImage& image, std::size_t task, std::size_t count);

/// Tests whether `name` is the name of a part of some task.
[[nodiscard]] bool is_part_of_task(std::string_view name);

/// Tests whether `name` is the name of a file of an engine.
[[nodiscard]] bool is_engine_file(std::string_view name);

/// Returns the file of that name in `folder`, that of a plan. Throws `Error` (invalid_input) for a
/// symbolic link, which may lead anywhere.
[[nodiscard]] std::filesystem::path file_of_plan(const std::filesystem::path& name,
                                                 const std::filesystem::path& folder);

}  // namespace bdpt::app
