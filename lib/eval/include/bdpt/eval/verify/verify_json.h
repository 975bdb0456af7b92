#pragma once

/// @file
/// Writes the report of a verification as JSON.
///
/// @code{.cpp}
/// void write_report(const bdpt::eval::VerifyReport& report)
/// {
///     std::cout << bdpt::eval::to_string(report.verdict) << '\n';
///     std::ofstream("verify.json") << bdpt::eval::verify_json(report, "room.glb");
/// }
/// @endcode

#include <bdpt/eval/verify/verify_report.h>
#include <bdpt/export.h>

#include <string>
#include <string_view>

namespace bdpt::eval {

/// Returns "pass", "fail" or "inconclusive".
[[nodiscard]] BDPT_EXPORT std::string_view to_string(Verdict verdict);

/// Returns the report as one line of JSON, as described in docs/verify.md, with a line break.
/// Numbers that are not finite are null; bytes of `scene` that are not UTF-8 are replaced.
[[nodiscard]] BDPT_EXPORT std::string verify_json(const VerifyReport& report,
                                                  std::string_view scene);

}  // namespace bdpt::eval
