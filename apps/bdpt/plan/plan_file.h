#pragma once

#include <filesystem>
#include <string>

#include "plan/plan.h"

namespace bdpt::app {

/// Of plan.json. It grows with every change that older programs would misread.
inline constexpr int plan_format = 2;

/// As JSON. Throws `Error` (usage) for a path that is not UTF-8.
[[nodiscard]] std::string to_text(const Plan& plan);

/// The plan in `file`, with paths as they are there. Throws `Error`: not_found, and invalid_input
/// for a file that is no plan, or one of another version.
[[nodiscard]] Plan read_plan(const std::filesystem::path& file);

/// What a path of a plan means here, as an absolute one.
[[nodiscard]] std::filesystem::path resolved(const std::filesystem::path& path,
                                             const std::filesystem::path& plan_file);

}  // namespace bdpt::app
