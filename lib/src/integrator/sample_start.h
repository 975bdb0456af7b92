#pragma once

#include "camera/moving_camera.h"
#include "camera/pixel_filter.h"
#include "math/sampler.h"
#include "scene/world.h"

namespace bdpt {

/// Draws what a sample of pixel (x, y) is before any of its paths, the same for all integrators:
/// where its camera path goes through the film [pixels], which is returned, and for the sampler its
/// wavelength and its time, where these matter.
[[nodiscard]] inline Vec2 start_sample(Sampler& sampler, const PixelFilter& filter,
                                       const World& world, const MovingCamera& camera, int x, int y)
{
    sampler.start(SampleUse::film);
    const Vec2 raster = filter.sample_raster(x, y, sampler.next_2d());
    if (world.disperses()) {
        sampler.set_wavelength(choose_wavelength(sampler.next_1d()));
    }
    if (world.moves() || camera.moves()) {
        sampler.set_time(sampler.next_1d());
    }
    return raster;
}

}  // namespace bdpt
