#pragma once

#include "pilot/pilot_brightness.h"

namespace bdpt {

/// relMSE of one sample per pixel that paths bring which a pilot found by merging: camera paths hit
/// a lamp over mirrors or glass so rarely that none of the pilot's own does. Paths that would not
/// come once in a usual render are no part of its error, and are left out.
[[nodiscard]] PerCandidate<double> merged_errors(const PilotFinds& finds,
                                                 const PilotBrightness& brightness);

}  // namespace bdpt
