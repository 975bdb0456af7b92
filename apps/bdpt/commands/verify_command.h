#pragma once

#include <bdpt/eval/verify/verify_report.h>

#include "options/verify_arguments.h"

namespace bdpt::app {

/// The exit codes of the two verdicts that are not a pass.
constexpr int verify_failed = 10;
constexpr int verify_inconclusive = 11;

/// 0 for a pass, else one of the above.
[[nodiscard]] int exit_code(eval::Verdict verdict);

/// `bdpt verify`: prints on stdout whether all estimators agree on the scene. The result is the
/// exit code. Throws `Error`.
[[nodiscard]] int run_verify(const VerifyArguments& arguments);

}  // namespace bdpt::app
