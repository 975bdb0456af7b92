#pragma once

#include "pilot/candidates.h"

#include <bdpt/render_stats.h>

namespace bdpt {

/// Returns the cost of a sample of the candidate [ns], from the counts of a pilot and fixed cost
/// factors, so that every machine makes the same choice. `pilot` connected each camera path to
/// `PathShares::pilot_connections` light paths.
[[nodiscard]] double sample_cost(const Candidate& candidate, const RenderStats& pilot);

/// Additional cost of connecting a point on a light to the lens [ns].
inline constexpr double visible_light_cost = 270.0;

}  // namespace bdpt
