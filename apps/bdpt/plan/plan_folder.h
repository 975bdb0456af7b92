#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "options/plan_arguments.h"
#include "plan/engines/engine_files.h"
#include "plan/plan.h"

namespace bdpt::app {

/// Refuses, before anything is loaded, a folder that could not be written: throws `Error` (output).
void check_plan_folder(const std::filesystem::path& folder);

/// Writes `plan` as plan.json into `folder`, which is made if it is not there, and `files` and what
/// `write_rates` writes into the file that it is given before it: with a plan there is all of it.
/// `write_rates` is not called for plans without rates. Throws `Error`: output, also when another
/// plan is there and is not to be replaced; invalid_input for a symbolic link in a file's place.
void write_plan(const std::filesystem::path& folder, const Plan& plan,
                const std::vector<EngineFile>& files,
                const std::function<void(const std::filesystem::path&)>& write_rates,
                ExistingPlan existing);

}  // namespace bdpt::app
