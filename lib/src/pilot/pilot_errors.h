#pragma once

#include "pilot/pilot_brightness.h"

namespace bdpt {

/// Returns the relMSE of one sample per pixel, excluding directly visible light.
[[nodiscard]] PerCandidate<double> predicted_errors(const PilotContributions& contributions,
                                                    const PilotBrightness& brightness);

}  // namespace bdpt
