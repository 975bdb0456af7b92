#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "plan/plan.h"

namespace bdpt::app {

/// Format version of plan.json. It is incremented with every change that older programs would
/// misread.
inline constexpr int plan_format = 2;

/// Maximum number of parts of a plan.
inline constexpr std::size_t max_planned_parts = 1'000'000;

/// Returns the plan as JSON. Throws `Error` (usage) for a path that is not UTF-8, and for a plan
/// too large to be read again.
[[nodiscard]] std::string to_text(const Plan& plan);

/// Reads the plan in `file`, with paths as stored. The file is not trusted: parts, rates and files
/// of engines are names of files that bdpt puts into its folder (plan/planned_files.h), and options
/// are those that `bdpt plan` writes. Throws `Error`: not_found, and invalid_input for a file that
/// is no such plan, or one of another version.
[[nodiscard]] Plan read_plan(const std::filesystem::path& file);

/// Returns a path of a plan as an absolute one.
[[nodiscard]] std::filesystem::path resolved(const std::filesystem::path& path,
                                             const std::filesystem::path& plan_file);

}  // namespace bdpt::app
