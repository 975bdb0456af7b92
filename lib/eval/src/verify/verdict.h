#pragma once

#include "verify/evidence.h"

#include <bdpt/eval/verify.h>

namespace bdpt::eval {

/// Performs all tests on the evidence and returns the report with the verdict, except for its time.
/// Needs two batches.
[[nodiscard]] VerifyReport judge(const Evidence& evidence, const VerifyOptions& options);

/// Tests whether errors as small as `options` ask for would have been found.
[[nodiscard]] bool is_sharp(const VerifyReport& report, const VerifyOptions& options);

}  // namespace bdpt::eval
