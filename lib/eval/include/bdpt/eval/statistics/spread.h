#pragma once

#include <bdpt/export.h>

#include <vector>

namespace bdpt::eval {

/// Median and range of some numbers.
struct Spread {
    double median = 0.0;
    double least = 0.0;
    double greatest = 0.0;
};

/// Returns the spread of at least one number; the median of an even count is the mean of the two in
/// the middle.
[[nodiscard]] BDPT_EXPORT Spread spread(std::vector<double> values);

}  // namespace bdpt::eval
