#pragma once

#include <bdpt/harness/compare/comparison_report.h>
#include <bdpt/harness/compare/threshold.h>

#include <span>
#include <string>

namespace bdpt::app {

/// The report as tables for people.
[[nodiscard]] std::string compare_text(const harness::ComparisonReport& report,
                                       std::span<const harness::ThresholdResult> thresholds);

}  // namespace bdpt::app
