#pragma once

/// @file
/// Writes the report of a comparison as JSON.
///
/// @code{.cpp}
/// void write_report(const bdpt::eval::ComparisonReport& report)
/// {
///     std::ofstream file("report.json");
///     file << bdpt::eval::comparison_json(report, {}, "out.exr", "reference.exr");
/// }
/// @endcode

#include <bdpt/eval/compare/comparison_report.h>
#include <bdpt/eval/compare/threshold.h>
#include <bdpt/export.h>

#include <span>
#include <string>

namespace bdpt::eval {

/// The report as a JSON object, as docs/compare.md describes it. What is not a finite number is
/// null. `image` and `reference` are what the user called them.
[[nodiscard]] BDPT_EXPORT std::string comparison_json(const ComparisonReport& report,
                                                      std::span<const ThresholdResult> thresholds,
                                                      const std::string& image,
                                                      const std::string& reference);

}  // namespace bdpt::eval
