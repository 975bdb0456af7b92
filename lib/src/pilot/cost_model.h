#pragma once

#include "pilot/candidates.h"

#include <bdpt/render_stats.h>

namespace bdpt {

/// Returns the number of connections that cast a shadow ray, for each camera path of the candidate.
/// `pilot` are the counts of a pilot, in a part of the image where camera paths are alike; it
/// connected each of them to `PathShares::pilot_connections` light paths.
[[nodiscard]] double connection_rays(const Candidate& candidate, const RenderStats& pilot);

/// Returns the cost of a sample of the candidate [ns], from the counts of a pilot, a number of
/// connections, and fixed cost factors, so that every machine makes the same choice.
[[nodiscard]] double sample_cost(const Candidate& candidate, const RenderStats& pilot,
                                 double connection_rays);

}  // namespace bdpt
