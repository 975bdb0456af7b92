#pragma once

#include "pilot/path_shares.h"

namespace bdpt {

/// Returns the contribution of a path to the errors that remain with well-distributed random
/// numbers: relMSE, where `scale` is the factor of squared errors in relMSE [1/nit^2].
[[nodiscard]] PerCandidate<double> remaining_errors(const PathShares& shares, double scale);

/// Remaining fractions of the variances of sums.
inline constexpr double left_of_direct_sums = 0.25;
inline constexpr double left_of_indirect_sums = 0.4;

}  // namespace bdpt
