#pragma once

#include "pilot/pilot_brightness.h"

#include <vector>

namespace bdpt {

/// Number of a usual render's samples per pixel.
inline constexpr double usual_samples = 64.0;

/// Returns the paths that a pilot found by merging, and a usual render finds: camera paths hit a
/// light by way of mirrors or glass so rarely that none of the pilot's own does. The brightest are
/// excluded, as long as a usual render with one light path per camera path would find less than one
/// of them: they do not affect its error.
[[nodiscard]] std::vector<const PilotContribution*> findable_merged_paths(
    const PilotContributions& contributions, const PilotBrightness& brightness);

/// Returns the fraction of the image's light that only merging can find, in [0, 1]: no candidate
/// finds it.
[[nodiscard]] double share_of_merging_alone(const PilotContributions& contributions,
                                            const PilotBrightness& brightness);

}  // namespace bdpt
