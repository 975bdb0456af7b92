#pragma once

#include <bdpt/eval/compare/comparison_report.h>
#include <bdpt/eval/compare/threshold.h>

#include <span>
#include <string>

namespace bdpt::app {

/// Returns the report as tables for people.
[[nodiscard]] std::string compare_text(const eval::ComparisonReport& report,
                                       std::span<const eval::ThresholdResult> thresholds);

}  // namespace bdpt::app
