#pragma once

#include "path/sample_context.h"

namespace bdpt::test {

/// Returns a sample at the opening of the shutter, of green light, without a clock.
[[nodiscard]] inline SampleContext make_sample(const World& world, const Camera& camera,
                                               const Sampler& sampler, RayCounts& rays)
{
    return {.world = world,
            .camera = camera,
            .sampler = sampler,
            .time = 0.0f,
            .wavelength = Wavelength::green,
            .rays = rays};
}

}  // namespace bdpt::test
