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

/// Format version of plan.json. It is incremented with every change that older programs would
/// misread.
inline constexpr int plan_format = 2;

/// Maximum number of parts of a plan.
inline constexpr std::size_t max_planned_parts = 1'000'000;

/// Returns the plan as JSON. Throws `Error` (usage) for a path that is not UTF-8, and for a plan
/// too large to be read again.
[[nodiscard]] std::string to_text(const Plan& plan);

/// Reads the plan in `file`, with paths as stored. The file is not trusted: parts, rates and files
/// of engines are names of files that bdpt puts into its folder (`is_part_of_task`), and options
/// are those that `bdpt plan` writes. Throws `Error`: not_found, and invalid_input for a file that
/// is no such plan, or one of another version.
[[nodiscard]] Plan read_plan(const std::filesystem::path& file);

/// Returns a path of a plan as an absolute one.
[[nodiscard]] std::filesystem::path resolved(const std::filesystem::path& path,
                                             const std::filesystem::path& plan_file);

}  // namespace bdpt::app
