#pragma once

#include "pilot/pilot_brightness.h"

namespace bdpt {

/// relMSE of one sample per pixel, but for light that is seen directly.
[[nodiscard]] PerCandidate<double> predicted_errors(const PilotContributions& contributions,
                                                    const PilotBrightness& brightness);

}  // namespace bdpt
