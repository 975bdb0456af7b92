#pragma once

#include "options/part_arguments.h"
#include "plan/plan.h"

namespace bdpt::app {

/// Refuses to replace a file of `arguments` because `plan` says so, unless it is an image that bdpt
/// wrote: the plan may come from anywhere. Throws `Error` (output).
void check_planned_outputs(const MergeArguments& arguments, const Plan& plan);

}  // namespace bdpt::app
