#pragma once

#include <bdpt/eval/bench.h>
#include <bdpt/eval/comparison.h>
#include <bdpt/eval/verify.h>

#include <span>
#include <string>

namespace bdpt::app {

/// Returns the results of a scene as a table for people. `seconds` is the CPU time of runs at equal
/// time.
[[nodiscard]] std::string bench_text(const eval::SceneResult& scene, double seconds);

/// Returns the report as tables for people.
[[nodiscard]] std::string compare_text(const eval::ComparisonReport& report,
                                       std::span<const eval::ThresholdResult> thresholds);

/// Returns the report as tables for people, the verdict last.
[[nodiscard]] std::string verify_text(const eval::VerifyReport& report,
                                      const eval::VerifyOptions& options);

}  // namespace bdpt::app
