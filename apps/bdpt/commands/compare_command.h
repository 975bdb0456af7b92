#pragma once

#include "options/compare_arguments.h"

namespace bdpt::app {

/// Exit code if a threshold is exceeded.
constexpr int compare_failed = 10;

/// Runs `bdpt compare`: prints the errors of images against a reference on stdout. Returns the exit
/// code: 0 or `compare_failed`. Throws `Error`; if only one output cannot be written, the others
/// have been.
[[nodiscard]] int run_compare(const CompareArguments& arguments);

}  // namespace bdpt::app
