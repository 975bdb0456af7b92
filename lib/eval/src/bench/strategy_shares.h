#pragma once

#include <bdpt/eval/bench.h>

#include "bench/bench_files.h"
#include "bench/progress_meter.h"

namespace bdpt::eval {

/// Measures the contribution of each strategy of bdpt: share of light and of variance, weighted and
/// unweighted, with small images for the report; and the mean path length in each pixel. Kept in a
/// file, and not measured again. Nothing is kept if stopped. Throws `Error` (output, out of
/// memory).
void measure_strategies(const BenchScene& scene, const BenchOptions& options,
                        const BenchFiles& files, const Reference& reference,
                        BenchProgressMeter& meter, const BenchControl& control);

}  // namespace bdpt::eval
