#pragma once

#include <bdpt/export.h>
#include <bdpt/render_options.h>

#include <array>
#include <optional>
#include <string_view>
#include <vector>

/// Judging renders: metrics, comparisons, benchmarks, proofs of estimators, reports.
namespace bdpt::eval {

/// Those of `integrators()`, from the simplest to the one that has all strategies.
[[nodiscard]] BDPT_EXPORT std::vector<IntegratorKind> all_integrators();
/// Those of them that are not biased.
[[nodiscard]] BDPT_EXPORT std::vector<IntegratorKind> unbiased_integrators();

/// In the order of the enumerators.
inline constexpr std::array all_heuristics{Heuristic::balance, Heuristic::power, Heuristic::cutoff,
                                           Heuristic::maximum, Heuristic::uniform};

/// `IntegratorInfo::name`.
[[nodiscard]] BDPT_EXPORT std::string_view to_string(IntegratorKind kind);
/// The enumerator of that name, if there is one.
[[nodiscard]] BDPT_EXPORT std::optional<IntegratorKind> parse_integrator(std::string_view name);
/// The enumerator's own name.
[[nodiscard]] BDPT_EXPORT std::string_view to_string(Heuristic heuristic);
/// The enumerator of that name, if there is one.
[[nodiscard]] BDPT_EXPORT std::optional<Heuristic> parse_heuristic(std::string_view name);

}  // namespace bdpt::eval
