#pragma once

#include "options/part_arguments.h"

namespace bdpt::app {

/// Exit code if samples are missing.
constexpr int merge_incomplete = 12;

/// Runs `bdpt merge`: merges parts of a render. Returns the exit code: 0 or `merge_incomplete`.
/// Throws `Error`.
[[nodiscard]] int run_merge(const MergeArguments& arguments);

}  // namespace bdpt::app
