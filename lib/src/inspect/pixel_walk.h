#pragma once

#include "camera/camera.h"
#include "film/pixel_filter.h"
#include "integrator/sample_schedule.h"
#include "light/learned/learned_light.h"
#include "path/random_walk.h"
#include "path/sample_context.h"

#include <bdpt/inspect.h>

#include <memory>

namespace bdpt {

/// Returns `options` with `automatic` resolved, for this sample alone and on one thread. Throws
/// like `inspect_sample`.
[[nodiscard]] RenderOptions inspected_options(const Scene& scene, const CameraDesc& camera,
                                              RenderOptions options, const PixelSample& sample);

/// The camera path of a sample, as integrators trace it.
class PixelWalk {
public:
    /// `options` are `inspected_options`. `scene` must outlive this object.
    PixelWalk(const Scene& scene, const CameraDesc& camera, const RenderOptions& options,
              const PixelSample& sample);
    PixelWalk(const PixelWalk&) = delete;
    PixelWalk& operator=(const PixelWalk&) = delete;

    [[nodiscard]] SampleContext& sample() { return sample_; }
    [[nodiscard]] Vec2 raster() const { return start_.raster; }
    [[nodiscard]] const Subpath& camera_path() const { return camera_path_; }
    [[nodiscard]] NextEventSampling next_event_sampling() const { return next_event_sampling_; }
    /// Returns the light path of the sample, if its integrator has one of its own.
    [[nodiscard]] Subpath light_path();

private:
    RenderOptions options_;
    MovingCamera camera_;
    SampleStart start_;
    TimedCamera timed_;
    RayCounts rays_;
    SampleContext sample_;
    std::shared_ptr<const LearnedLight> learned_;
    NextEventSampling next_event_sampling_;
    Subpath camera_path_;
};

}  // namespace bdpt
