#pragma once

#include "pilot/pilot_brightness.h"

namespace bdpt {

/// Errors of light that is seen directly: relMSE of one sample per pixel, of this light alone.
struct VisibleLightErrors {
    double by_hits = 0.0;  ///< camera paths have to hit the lamp (s = 0)
    double by_both = 0.0;  ///< points of lamps are joined to the lens, too (s = t = 1)
};

/// From what points of lamps a pilot has seen. Camera paths miss lamps that fill a small part of a
/// pixel; those that fill it they cannot miss.
[[nodiscard]] VisibleLightErrors visible_light_errors(const PilotContributions& contributions,
                                                      const PilotBrightness& brightness);

}  // namespace bdpt
