#pragma once

#include "options/compare_arguments.h"

namespace bdpt::app {

/// The exit code when a threshold is exceeded.
constexpr int compare_failed = 10;

/// `bdpt compare`: prints how far images are from a reference on stdout. The result is the exit
/// code: 0 or `compare_failed`. Throws `Error`; when only one output cannot be written, the others
/// have been.
[[nodiscard]] int run_compare(const CompareArguments& arguments);

}  // namespace bdpt::app
