#pragma once

#include <bdpt/harness/verify/verify_options.h>
#include <bdpt/harness/verify/verify_report.h>

#include <string>

namespace bdpt::app {

/// The report as tables for people, the verdict last.
[[nodiscard]] std::string verify_text(const harness::VerifyReport& report,
                                      const harness::VerifyOptions& options);

}  // namespace bdpt::app
