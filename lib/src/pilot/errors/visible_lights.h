#pragma once

#include "pilot/pilot_brightness.h"

namespace bdpt {

/// Errors of directly visible light: relMSE of one sample per pixel, of this light alone.
struct VisibleLightErrors {
    double by_hits = 0.0;  ///< camera paths have to hit the light (s = 0)
    double by_both = 0.0;  ///< points on lights are also connected to the lens (s = t = 1)
};

/// Computes the errors of renders with `options` from points on lights that a pilot has seen, one
/// for each of its samples. Camera paths miss lights that fill a small part of a pixel; those that
/// fill it they cannot miss.
[[nodiscard]] VisibleLightErrors visible_light_errors(const PilotContributions& contributions,
                                                      const PilotBrightness& brightness,
                                                      const RenderOptions& options);

}  // namespace bdpt
