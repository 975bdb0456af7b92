#pragma once

#include <bdpt/eval/verify/verify_options.h>
#include <bdpt/eval/verify/verify_report.h>

#include <string>

namespace bdpt::app {

/// Returns the report as tables for people, the verdict last.
[[nodiscard]] std::string verify_text(const eval::VerifyReport& report,
                                      const eval::VerifyOptions& options);

}  // namespace bdpt::app
