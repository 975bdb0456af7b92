#pragma once

#include "camera/moving_camera.h"
#include "film/pixel_filter.h"
#include "math/sampler.h"
#include "scene/world.h"

#include <bdpt/render_options.h>

namespace bdpt {

/// Shutter time and wavelength, which both subpaths of a path must share.
struct TimeAndWavelength {
    float time = 0.0f;
    Wavelength wavelength = Wavelength::green;
};

/// Draws time and wavelength if the scene depends on them.
[[nodiscard]] inline TimeAndWavelength draw_time_and_wavelength(Sampler& sampler,
                                                                const World& world,
                                                                const MovingCamera& camera)
{
    TimeAndWavelength moment;
    if (world.disperses()) {
        moment.wavelength = choose_wavelength(sampler.next_1d());
    }
    if (world.moves() || camera.moves()) {
        moment.time = sampler.next_1d();
    }
    return moment;
}

/// Start of a pixel's sample, before any of its paths; the same for all integrators.
struct SampleStart {
    Sampler sampler;
    Vec2 raster;  ///< raster position of its camera path on the film [pixels]
    TimeAndWavelength moment;

    SampleStart(const RenderOptions& options, const PixelFilter& filter, const World& world,
                const MovingCamera& camera, int x, int y, std::int64_t index)
        : sampler(options.sampling.sampler, options.sampling.seed, x, y, index)
    {
        sampler.start(SampleUse::film);
        raster = filter.sample_raster(x, y, sampler.next_2d());
        moment = draw_time_and_wavelength(sampler, world, camera);
    }
};

}  // namespace bdpt
