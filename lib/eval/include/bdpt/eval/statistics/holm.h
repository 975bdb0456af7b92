#pragma once

/// @file
/// Corrects the p-values of many tests.
///
/// @code{.cpp}
/// const std::vector<double> p = {0.01, 0.2, 0.04};
/// const std::vector<double> adjusted = bdpt::eval::holm_adjusted(p);  // 0.03, 0.2, 0.08
/// @endcode

#include <bdpt/export.h>

#include <span>
#include <vector>

namespace bdpt::eval {

/// Returns adjusted p-values of many tests, in their order: if the tests with an adjusted p of at
/// most a are taken as significant, the probability of any false positive is at most a [Holm 1979].
[[nodiscard]] BDPT_EXPORT std::vector<double> holm_adjusted(std::span<const double> p);

}  // namespace bdpt::eval
