#pragma once

#include "pilot/pilot_brightness.h"

namespace bdpt {

/// Returns the relMSE of one sample per pixel of paths that a pilot found by merging: camera paths
/// hit a light by way of mirrors or glass so rarely that none of the pilot's own does. Paths that
/// would not be sampled once in a usual render are excluded, as they do not affect its error.
[[nodiscard]] PerCandidate<double> merged_errors(const PilotContributions& contributions,
                                                 const PilotBrightness& brightness);

/// Returns the fraction of the image's light that only merging can find, in [0, 1]: no candidate
/// finds it.
[[nodiscard]] double share_of_merging_alone(const PilotContributions& contributions,
                                            const PilotBrightness& brightness);

}  // namespace bdpt
