#pragma once

#include <bdpt/export.h>

#include <span>
#include <vector>

namespace bdpt::eval {

/// Adjusted p-values of many tests, in their order: the chance that any of the tests is wrong by
/// chance is at most a when those with an adjusted p of at most a are believed [Holm 1979].
[[nodiscard]] BDPT_EXPORT std::vector<double> holm_adjusted(std::span<const double> p);

}  // namespace bdpt::eval
