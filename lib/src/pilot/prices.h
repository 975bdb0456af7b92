#pragma once

#include "pilot/candidates.h"

#include <bdpt/render_stats.h>

namespace bdpt {

/// What a sample of the candidate costs [ns], from the counts of a pilot and fixed prices, so that
/// every machine chooses alike. `pilot` had light paths of its own for each camera path, and
/// connected them all.
[[nodiscard]] double sample_cost(const Candidate& candidate, const RenderStats& pilot);

}  // namespace bdpt
