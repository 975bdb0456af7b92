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

/// Evaluation of renders: metrics, comparisons, benchmarks, verification of estimators, reports.
namespace bdpt::eval {

/// Returns the kinds of `integrators()`, from the simplest to the one that has all strategies.
[[nodiscard]] BDPT_EXPORT std::vector<IntegratorKind> all_integrators();
/// Returns the kinds of `all_integrators()` that are unbiased.
[[nodiscard]] BDPT_EXPORT std::vector<IntegratorKind> unbiased_integrators();

}  // namespace bdpt::eval
