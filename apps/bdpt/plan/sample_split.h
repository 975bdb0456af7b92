#pragma once

#include <bdpt/render_options.h>

#include <cstdint>
#include <vector>

namespace bdpt::app {

/// Splits `samples` into `parts` consecutive ranges of about equal size. They end at multiples of
/// 64, or of a smaller power of two if there are too few samples: such ranges keep Sobol points
/// well spread. `parts` is in [1, number of samples]; the power of two is at least `least`, itself
/// a power of two, and there are at least `parts` multiples of it.
[[nodiscard]] std::vector<SampleRange> split_samples(SampleRange samples, std::int64_t parts,
                                                     std::int64_t least = 1);

/// Returns the number of ranges that take at most `seconds` each and are of multiples of 64
/// samples, or of a power of two if 64 take longer; at least `least` samples each. A sample takes
/// `seconds_per_sample`, and a range `seconds_to_start`.
[[nodiscard]] std::int64_t parts_of_time(SampleRange samples, double seconds,
                                         double seconds_per_sample, double seconds_to_start,
                                         std::int64_t least = 1);

}  // namespace bdpt::app
