#pragma once

#include <string>
#include <vector>

#include "options/bench_arguments.h"

namespace bdpt::app {

/// Runs a benchmark and writes its report. `command` is the command line as typed, for the record.
/// Returns the exit code. Throws `Error`; results of finished runs are written before.
[[nodiscard]] int run_bench(const BenchArguments& arguments,
                            const std::vector<std::string>& command);

}  // namespace bdpt::app
