#include "inspect/pixel_walk.h"

#include "path/strategy_set.h"
#include "render/learned_light.h"
#include "render/open_camera.h"

#include <bdpt/error.h>
#include <bdpt/options/integrators.h>
#include <bdpt/render.h>

#include <string>

namespace bdpt {
namespace {

NextEventSampling find_sampling(const RenderOptions& options, const LearnedLight* learned)
{
    if (info(options.integrator).has_strategies) {
        return StrategySet(options, learned).next_event_sampling();
    }
    const bool weighs = options.integrator == IntegratorKind::mis;
    return {.environments = weighs ? options.sampling.environment : EnvironmentSampling::plain,
            .lights = options.sampling.lights,
            .learned = weighs ? learned : nullptr};
}

WalkLimits make_limits(const RenderOptions& options, int max_vertices)
{
    return {.max_vertices = max_vertices,
            .rr_start = options.transport.rr_start,
            .rr_survival = options.transport.rr_survival};
}

}  // namespace

RenderOptions inspected_options(const Scene& scene, const CameraDesc& camera, RenderOptions options,
                                const PixelSample& sample)
{
    const bool in_image = sample.x >= 0 && sample.y >= 0 && sample.x < options.film.width &&
                          sample.y < options.film.height;
    if (!in_image) {
        throw Error(ErrorCode::usage,
                    "pixel " + std::to_string(sample.x) + "," + std::to_string(sample.y) +
                        " is outside of the image of " + std::to_string(options.film.width) + "x" +
                        std::to_string(options.film.height) + " pixels");
    }
    options.bidirectional.strategy_depth = 0;
    options = chosen_options(scene, camera, options);  // before the crop, which has its own choice
    options.film.crop =
        PixelRect{.x0 = sample.x, .y0 = sample.y, .x1 = sample.x + 1, .y1 = sample.y + 1};
    options.film.aovs = {};
    options.sampling.samples = {.begin = sample.index, .end = sample.index + 1};
    options.sampling.rates = nullptr;
    options.system.threads = 1;
    if (options.integrator == IntegratorKind::vcm) {
        throw Error(ErrorCode::usage,
                    "vcm cannot be inspected: its merged paths belong to no strategy (s, t)");
    }
    return options;
}

PixelWalk::PixelWalk(const Scene& scene, const CameraDesc& camera, const RenderOptions& options,
                     const PixelSample& sample)
    : options_(options),
      camera_(open_camera(scene.world(), camera, options)),
      start_(options_, PixelFilter(options.film.filter), scene.world(), camera_, sample.x, sample.y,
             sample.index),
      timed_(camera_, start_.moment.time),
      sample_{.world = scene.world(),
              .camera = timed_.get(),
              .sampler = start_.sampler,
              .time = start_.moment.time,
              .wavelength = start_.moment.wavelength,
              .rays = rays_},
      learned_(learned_light(scene.world(), camera, options)),
      next_event_sampling_(find_sampling(options, learned_.get())),
      camera_path_(options.transport.max_depth + 1)
{
    trace_camera_subpath(sample_, start_.raster, make_limits(options_, camera_path_.capacity()),
                         camera_path_);
}

Subpath PixelWalk::light_path()
{
    const bool own =
        info(options_.integrator).traces_light_paths && !LightPathCounts(options_).shared;
    Subpath path(own ? StrategySet(options_).light_vertices() : 0);
    if (path.capacity() > 0) {
        trace_light_subpath(sample_, make_limits(options_, path.capacity()), next_event_sampling_,
                            path);
    }
    return path;
}

}  // namespace bdpt
