#pragma once

#include "pilot/path_shares.h"

namespace bdpt {

/// What a path adds to the errors that are left when random numbers are well spread: relMSE, where
/// `scale` is what relMSE multiplies squares by [1/nit^2].
[[nodiscard]] PerCandidate<double> remaining_errors(const PathShares& shares, double scale);

/// The parts of the variances of sums that are left.
inline constexpr double left_of_direct_sums = 0.25;
inline constexpr double left_of_indirect_sums = 0.4;

}  // namespace bdpt
