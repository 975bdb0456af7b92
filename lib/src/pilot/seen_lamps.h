#pragma once

#include "pilot/pilot_brightness.h"

namespace bdpt {

/// Errors of light that is seen directly: relMSE of one sample per pixel, of this light alone.
struct SeenLampErrors {
    double by_hits = 0.0;  ///< camera paths have to hit the lamp (s = 0)
    double by_both = 0.0;  ///< points of lamps are joined to the lens, too (s = t = 1)
};

/// From what points of lamps a pilot has seen. Camera paths miss lamps that fill a small part of a
/// pixel; those that fill it they cannot miss.
[[nodiscard]] SeenLampErrors seen_lamp_errors(const PilotFinds& finds,
                                              const PilotBrightness& brightness);

}  // namespace bdpt
