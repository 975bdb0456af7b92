#pragma once

#include <bdpt/render_options.h>

#include <cstdint>
#include <vector>

namespace bdpt::app {

/// `samples` as `parts` ranges, one after the other and of about one size. They end at multiples of
/// 64, or of a smaller power of two where there are too few samples for that: such ranges keep
/// Sobol points well spread. `parts` is in [1, number of samples]; the power of two is not less
/// than `least`, a power of two itself, of which there are `parts` at least.
[[nodiscard]] std::vector<SampleRange> split_samples(SampleRange samples, std::int64_t parts,
                                                     std::int64_t least = 1);

/// Number of ranges that take at most `seconds` each and are of multiples of 64 samples, or of a
/// power of two where 64 take longer; at least `least` samples each. A sample takes
/// `seconds_per_sample`, and a range `seconds_to_start`.
[[nodiscard]] std::int64_t parts_of_time(SampleRange samples, double seconds,
                                         double seconds_per_sample, double seconds_to_start,
                                         std::int64_t least = 1);

}  // namespace bdpt::app
