#pragma once

#include "options/inspect_arguments.h"

namespace bdpt::app {

/// Prints the paths of the sample, and writes its image of directions. Returns the exit code.
/// Throws `Error`.
int run_inspect(const InspectArguments& arguments);

}  // namespace bdpt::app
