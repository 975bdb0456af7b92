#pragma once

#include "camera/camera.h"
#include "integrator/sample_start.h"
#include "light/light_samples.h"
#include "math/sampler.h"
#include "scene/world.h"

#include <bdpt/film/aov_film.h>
#include <bdpt/render_options.h>
#include <bdpt/render_stats.h>

#include <cstdint>
#include <optional>

namespace bdpt {

/// A shadow catcher: direct light on a level ground that is no part of the scene, with and without
/// the scene in its way. The ground reflects nothing and is seen by camera rays alone
/// (docs/decisions/0054-shadow-catcher.md).
class GroundShadow {
public:
    /// The world must outlive this.
    GroundShadow(const World& world, const RenderOptions& options);

    /// Light where a camera ray that meets no surface meets the ground: an estimate of its
    /// irradiance, and the shadow rays that it took. Nothing where the ray does not come down to
    /// the ground within reach of rays.
    [[nodiscard]] std::optional<GroundLight> light_at(const CameraRay& ray,
                                                      const SampleMoment& moment, Sampler& sampler,
                                                      RayCounts& rays) const;

private:
    struct Point;
    [[nodiscard]] std::optional<SegmentEnd> meet(const CameraRay& ray) const;
    [[nodiscard]] GroundLight sampled_light(const Point& point, int number) const;
    [[nodiscard]] GroundLight sampled_sky(const Point& point, int number) const;
    /// Does a surface of the light itself stand between the ground and this point of it?
    [[nodiscard]] bool hides_itself(const Point& point, LightId id, const IncidentSample& light,
                                    SegmentKey segment) const;

    const World& world_;
    float height_;
    NextEventSampling sampling_;
};

}  // namespace bdpt
