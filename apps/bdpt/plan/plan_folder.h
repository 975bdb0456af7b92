#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "options/plan_arguments.h"
#include "plan/engine_files.h"
#include "plan/plan.h"

namespace bdpt::app {

/// Throws `Error` (output), before anything is loaded, for a folder that could not be written.
void check_plan_folder(const std::filesystem::path& folder);

/// Writes `plan` as plan.json into `folder`, which is created if necessary. Before that it writes
/// `files`, and calls `write_rates` with the file for rates, so that a plan is always complete.
/// `write_rates` is not called for plans without rates. Throws `Error`: output, also if another
/// plan exists and is not to be replaced; invalid_input for a symbolic link in a file's place.
void write_plan(const std::filesystem::path& folder, const Plan& plan,
                const std::vector<EngineFile>& files,
                const std::function<void(const std::filesystem::path&)>& write_rates,
                ExistingPlan existing);

}  // namespace bdpt::app
