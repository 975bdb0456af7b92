#pragma once

/// @file
/// Lists the integrators that benchmarks compare.
///
/// @code{.cpp}
/// for (const bdpt::IntegratorKind kind : bdpt::eval::unbiased_integrators()) {
///     std::cout << bdpt::info(kind).name << '\n';
/// }
/// @endcode

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
