#pragma once

#include <bdpt/export.h>
#include <bdpt/render_options.h>

#include <vector>

/// Judging renders: metrics, comparisons, benchmarks, proofs of estimators, reports.
namespace bdpt::eval {

/// Those of `integrators()`, from the simplest to the one that has all strategies.
[[nodiscard]] BDPT_EXPORT std::vector<IntegratorKind> all_integrators();
/// Those of them that are not biased.
[[nodiscard]] BDPT_EXPORT std::vector<IntegratorKind> unbiased_integrators();

}  // namespace bdpt::eval
