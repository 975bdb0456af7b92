#pragma once

/// @file
/// Finds the median and the extremes of some numbers.
///
/// @code{.cpp}
/// const bdpt::eval::Spread seconds = bdpt::eval::spread({1.2, 0.9, 1.1});
/// std::cout << seconds.median << ", from " << seconds.least << " to " << seconds.greatest << '\n';
/// @endcode

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
