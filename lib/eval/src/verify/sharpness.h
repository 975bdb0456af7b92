#pragma once

#include "verify/evidence.h"

#include <bdpt/eval/verify.h>

namespace bdpt::eval {

/// Samples of bdpt in the whole image from which on detectability can be trusted. With fewer,
/// ordinary samples look like rare ones, and an error raises the noise that it hides in.
constexpr double trusted_samples = 262144.0;

/// Fills in the detectable error of each comparison, and returns the worst of all strategies:
/// relative errors of the image's mean that are found with a probability of 90 %. A difference is
/// found from `distance` standard errors on.
[[nodiscard]] double find_detectable(const Evidence& evidence, VerifyReport& report,
                                     double distance);

/// Returns the least relative error of merging that is found with a probability of 90 %.
[[nodiscard]] double find_detectable_of_merging(const Evidence& evidence,
                                                const VerifyReport& report, double distance);

}  // namespace bdpt::eval
