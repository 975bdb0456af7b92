#pragma once

#include "options/part_arguments.h"

namespace bdpt::app {

/// The exit code when samples are missing.
constexpr int merge_incomplete = 12;

/// `bdpt merge`: adds parts of a render. The result is the exit code: 0 or `merge_incomplete`.
/// Throws `Error`.
[[nodiscard]] int run_merge(const MergeArguments& arguments);

}  // namespace bdpt::app
