#pragma once

#include <bdpt/eval/verify/verify_report.h>

#include "options/verify_arguments.h"

namespace bdpt::app {

/// Exit codes of the two verdicts that are not a pass.
constexpr int verify_failed = 10;
constexpr int verify_inconclusive = 11;

/// Returns 0 for a pass, else one of the codes above.
[[nodiscard]] int exit_code(eval::Verdict verdict);

/// Runs `bdpt verify`: prints on stdout whether all estimators agree on the scene. Returns the exit
/// code. Throws `Error`.
[[nodiscard]] int run_verify(const VerifyArguments& arguments);

}  // namespace bdpt::app
