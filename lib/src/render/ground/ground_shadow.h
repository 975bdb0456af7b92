#pragma once

#include "camera/camera.h"
#include "integrator/sample_start.h"
#include "light/light_samples.h"
#include "math/sampler.h"
#include "render/ground/ground_lamps.h"
#include "render/ground/ground_occluders.h"
#include "render/ground/ground_sky.h"
#include "scene/world.h"

#include <bdpt/film/aov_film.h>
#include <bdpt/render_options.h>
#include <bdpt/render_stats.h>

#include <cstdint>
#include <optional>
#include <vector>

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
                                                      const TimeAndWavelength& moment,
                                                      Sampler& sampler, RayCounts& rays) const;

private:
    struct Point;
    [[nodiscard]] std::optional<SegmentEnd> meet(const CameraRay& ray) const;
    void add_sky(const Point& point, GroundLight& sum) const;
    void add_suns(const Point& point, GroundLight& sum) const;
    void add_lamps(const Point& point, GroundLight& sum) const;
    /// What the light brings, and what of it gets past the scene.
    [[nodiscard]] GroundLight past_scene(const Point& point, LightId id,
                                         const IncidentSample& light, Rgb irradiance,
                                         std::uint32_t ray) const;
    /// Does a surface of the light itself stand between the ground and this point of it?
    [[nodiscard]] bool hides_itself(const Point& point, LightId id, const IncidentSample& light,
                                    SegmentKey segment) const;

    const World& world_;
    float height_;
    std::optional<GroundOccluders> occluders_;  // if a shadow is asked for
    std::optional<GroundSky> sky_;
    std::vector<LightId> suns_;  // all others at infinity
    std::optional<GroundLamps> lamps_;
    bool has_other_lights_ = false;
};

}  // namespace bdpt
