#pragma once

#include "verify/evidence.h"

#include <bdpt/eval/verify/verify_options.h>
#include <bdpt/eval/verify/verify_report.h>

namespace bdpt::eval {

/// All tests of what has been gathered, and the verdict; but for the time it took. Needs two
/// batches.
[[nodiscard]] VerifyReport judge(const Evidence& evidence, const VerifyOptions& options);

/// Would errors that are as small as `options` ask for have been found?
[[nodiscard]] bool is_sharp(const VerifyReport& report, const VerifyOptions& options);

}  // namespace bdpt::eval
