#pragma once

#include "verify/evidence.h"

#include <bdpt/harness/verify/verify_options.h>
#include <bdpt/harness/verify/verify_report.h>

namespace bdpt::harness {

/// Fills in what each comparison could detect, and returns the worst of all strategies: errors that
/// change the mean of the picture by that fraction are found with 90 % chance. A difference is
/// found from `distance` standard errors on.
[[nodiscard]] double find_detectable(const Evidence& evidence, VerifyReport& report,
                                     double distance);

}  // namespace bdpt::harness
