#pragma once

#include "camera/camera.h"
#include "math/sampler.h"
#include "math/segment_key.h"
#include "math/wavelength.h"
#include "profile/phase_clock.h"
#include "scene/world.h"

#include <bdpt/render_stats.h>

namespace bdpt {

/// The state of one sample of a pixel, which all of its paths share.
struct SampleContext {
    const World& world;
    const Camera& camera;  ///< as it is at `time`
    Sampler sampler;
    float time;  ///< in [0, 1] while the shutter is open
    Wavelength wavelength;
    RayCounts& rays;    ///< counts the rays that are traced
    PhaseClock* clock;  ///< null if this sample is not clocked

    /// Names the segment with `s` vertices on the light's side and `t` on the camera's; see
    /// `Sampler::segment_key`.
    [[nodiscard]] SegmentKey segment(int s, int t) const
    {
        SegmentKey key = sampler.segment_key(s, t);
        key.wavelength = wavelength;
        key.time = time;
        return key;
    }
    /// From here on, time counts for `phase`.
    void enter(Phase phase) const noexcept
    {
        if (clock != nullptr) [[unlikely]] {
            clock->enter(phase);
        }
    }
};

}  // namespace bdpt
