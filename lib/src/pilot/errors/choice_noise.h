#pragma once

#include "pilot/pilot_brightness.h"

namespace bdpt {

/// Returns the second moments that the choice of connections adds, over those of all connections,
/// for each candidate. The pilot's connections tell it for the paths that they found; it is assumed
/// for paths that other strategies found.
[[nodiscard]] PerCandidate<double> measure_choice(const PilotContributions& contributions,
                                                  const PilotBrightness& brightness);

}  // namespace bdpt
