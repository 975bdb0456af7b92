#pragma once

#include "pilot/candidates.h"

#include <bdpt/render_stats.h>

namespace bdpt {

/// What a sample of the candidate costs [ns], from the counts of a pilot and fixed prices, so that
/// every machine chooses alike. `pilot` connected each camera path to
/// `PathShares::pilot_connections` light paths.
[[nodiscard]] double sample_cost(const Candidate& candidate, const RenderStats& pilot);

/// What it costs more to join a point of a lamp to the lens [ns].
inline constexpr double visible_light_cost = 230.0;

}  // namespace bdpt
