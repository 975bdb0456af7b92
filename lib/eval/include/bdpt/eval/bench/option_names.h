#pragma once

#include <bdpt/export.h>
#include <bdpt/render_options.h>

#include <array>
#include <optional>
#include <string_view>

/// Judging renders: metrics, comparisons, benchmarks, proofs of estimators, reports.
namespace bdpt::eval {

/// From the simplest to the one that has all strategies.
inline constexpr std::array all_integrators{IntegratorKind::pt, IntegratorKind::nee,
                                            IntegratorKind::mis, IntegratorKind::lt,
                                            IntegratorKind::bdpt};

/// In the order of the enumerators.
inline constexpr std::array all_heuristics{Heuristic::balance, Heuristic::power, Heuristic::cutoff,
                                           Heuristic::maximum, Heuristic::uniform};

/// The enumerator's own name.
[[nodiscard]] BDPT_EXPORT std::string_view to_string(IntegratorKind kind);
/// The enumerator of that name, if there is one.
[[nodiscard]] BDPT_EXPORT std::optional<IntegratorKind> parse_integrator(std::string_view name);
/// The enumerator's own name.
[[nodiscard]] BDPT_EXPORT std::string_view to_string(Heuristic heuristic);
/// The enumerator of that name, if there is one.
[[nodiscard]] BDPT_EXPORT std::optional<Heuristic> parse_heuristic(std::string_view name);

}  // namespace bdpt::eval
