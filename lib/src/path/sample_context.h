#pragma once

#include "camera/camera.h"
#include "math/random_numbers.h"
#include "math/rgb.h"
#include "math/sampler.h"
#include "scene/world.h"

#include <bdpt/render_stats.h>

namespace bdpt {

/// State of one sample of a pixel, shared by all of its paths.
struct SampleContext {
    const World& world;
    const Camera& camera;  ///< camera at `time`
    Sampler sampler;
    float time;  ///< time within the shutter interval, in [0, 1]
    Wavelength wavelength;
    RayCounts& rays;  ///< counts the rays that are traced

    /// Returns the key of the segment with `s` vertices on the light's side and `t` on the
    /// camera's; see `Sampler::segment_key`.
    [[nodiscard]] SegmentKey segment(int s, int t) const
    {
        SegmentKey key = sampler.segment_key(s, t);
        key.wavelength = wavelength;
        key.time = time;
        return key;
    }
};

}  // namespace bdpt
