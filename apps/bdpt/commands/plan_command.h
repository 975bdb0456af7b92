#pragma once

#include "options/plan_arguments.h"

namespace bdpt::app {

/// Loads the scene, chooses the options left open, and writes the plan and the files of its engine.
/// Returns the exit code. Throws `Error`.
[[nodiscard]] int run_plan(const PlanArguments& arguments);

}  // namespace bdpt::app
