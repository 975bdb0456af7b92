#pragma once

#include "path/sample_context.h"

namespace bdpt::test {

/// A sample when the shutter opens, of green light, that nobody clocks.
[[nodiscard]] inline SampleContext sample_of(const World& world, const Camera& camera,
                                             const Sampler& sampler, RayCounts& rays)
{
    return {.world = world,
            .camera = camera,
            .sampler = sampler,
            .time = 0.0f,
            .wavelength = Wavelength::green,
            .rays = rays,
            .clock = nullptr};
}

}  // namespace bdpt::test
