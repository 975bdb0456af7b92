#pragma once

#include "verify/evidence.h"

#include <bdpt/harness/verify/verify_options.h>
#include <bdpt/harness/verify/verify_report.h>

namespace bdpt::harness {

/// All tests of what has been gathered, and the verdict; but for the time it took. Needs two
/// batches.
[[nodiscard]] VerifyReport judge(const Evidence& evidence, const VerifyOptions& options);

}  // namespace bdpt::harness
