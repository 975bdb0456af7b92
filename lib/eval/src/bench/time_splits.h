#pragma once

#include <bdpt/eval/bench/bench.h>

#include <optional>
#include <string>

#include "bench/bench_files.h"
#include "bench/progress_meter.h"

namespace bdpt::eval {

/// Fraction of a run's time that the render for the time split of its integrator takes.
inline constexpr double split_share = 0.5;

/// Returns the time split of each integrator that `goals` name, in their order; of fewer if
/// stopped. Each is kept in a file with a map of its pixels, and not measured again. Throws
/// `Error`: output if a file cannot be written, invalid_input if an existing one is broken.
[[nodiscard]] std::vector<TimeSplit> measure_time_splits(
    const BenchScene& scene, const BenchOptions& options, const BenchFiles& files,
    const std::vector<BenchGoals>& goals, BenchProgressMeter& meter, const BenchControl& control);

/// Returns the map of time per pixel from the file of a time split, packed for the report: 0 for no
/// time, else 1 + 12 log2(t / 2^-28 s) for a sample that takes t. Returns none if there is no such
/// file.
[[nodiscard]] std::optional<std::string> packed_time_map(const BenchFiles& files,
                                                         IntegratorKind integrator);

}  // namespace bdpt::eval
