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

/// Returns the report as a JSON object, as described in docs/compare.md. Numbers that are not
/// finite are null. `image` and `reference` are their names as the user gave them.
[[nodiscard]] BDPT_EXPORT std::string comparison_json(const ComparisonReport& report,
                                                      std::span<const ThresholdResult> thresholds,
                                                      const std::string& image,
                                                      const std::string& reference);

}  // namespace bdpt::eval
