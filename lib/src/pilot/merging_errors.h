#pragma once

#include "pilot/pilot_brightness.h"

namespace bdpt {

/// relMSE of one sample per pixel that paths bring which a pilot found by merging: camera paths hit
/// a lamp over mirrors or glass so rarely that none of the pilot's own does. Paths that would not
/// come once in a usual render are no part of its error, and are left out.
[[nodiscard]] PerCandidate<double> merged_errors(const PilotContributions& contributions,
                                                 const PilotBrightness& brightness);

/// The share of the light of the image that merging alone can find, in [0, 1]: no candidate has it.
[[nodiscard]] double share_of_merging_alone(const PilotContributions& contributions,
                                            const PilotBrightness& brightness);

}  // namespace bdpt
