#pragma once

#include "pilot/pilot_brightness.h"

namespace bdpt {

/// Returns the second moments that the choice of connections adds, over those of all connections,
/// for each candidate. They are measured by the paths that the pilot's connections found, and are
/// the best estimate for paths that other strategies found.
[[nodiscard]] PerCandidate<double> measure_choice(const PilotContributions& contributions,
                                                  const PilotBrightness& brightness);

}  // namespace bdpt
