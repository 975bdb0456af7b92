#pragma once

#include "verify/evidence.h"

#include <bdpt/eval/verify/verify_options.h>
#include <bdpt/eval/verify/verify_report.h>

namespace bdpt::eval {

/// Samples of bdpt in the whole image from which on what is said to be detectable can be relied
/// on. With fewer, ordinary samples pass for rare ones, and an error raises the noise that it hides
/// in.
constexpr double trusted_samples = 262144.0;

/// Fills in what each comparison could detect, and returns the worst of all strategies: errors that
/// change the mean of the image by that fraction are found with 90 % chance. A difference is
/// found from `distance` standard errors on.
[[nodiscard]] double find_detectable(const Evidence& evidence, VerifyReport& report,
                                     double distance);

/// The least relative error of merging that is found with 90 % chance.
[[nodiscard]] double find_detectable_of_merging(const Evidence& evidence,
                                                const VerifyReport& report, double distance);

}  // namespace bdpt::eval
