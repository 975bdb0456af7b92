#pragma once

#include "options/part_arguments.h"
#include "plan/plan.h"

namespace bdpt::app {

/// Throws `Error` (output) if the plan makes `arguments` replace a file that is not an image
/// written by bdpt: plans are not trusted.
void check_planned_outputs(const MergeArguments& arguments, const Plan& plan);

}  // namespace bdpt::app
