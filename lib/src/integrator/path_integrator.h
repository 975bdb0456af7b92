#pragma once

#include "camera/pixel_filter.h"
#include "integrator/integrator.h"

#include "scene/world.h"

namespace bdpt {

class Sampler;

/// Path tracing from the camera. `pt` finds lights by BSDF sampling alone, but for delta lights,
/// which no such sample can hit; `mis` weighs BSDF sampling and light sampling [Veach 1997, ch. 9].
class PathIntegrator final : public Integrator {
public:
    PathIntegrator(const World& world, const Camera& camera, const RenderOptions& options);
    [[nodiscard]] RenderStats render_tile(const Tile& tile, SampleRange samples,
                                          Film& film) const override;
    [[nodiscard]] bool splats() const override { return false; }

private:
    struct Ray;
    [[nodiscard]] Rgb estimate(Vec2 raster, Sampler& sampler, RayCounts& rays) const;
    /// Radiance that the ray brings from a light it hit, weighed against light sampling.
    [[nodiscard]] Rgb emission(const Ray& ray, LightId light, const LightPoint& hit,
                               Rgb radiance) const;
    [[nodiscard]] Rgb sample_light(const SurfacePoint& point, Vec3 wo, Sampler& sampler,
                                   RayCounts& rays) const;
    /// Weight of the technique with density `used` against the one with density `other`.
    [[nodiscard]] float weight(float used, float other) const;

    const World& world_;
    const Camera& camera_;
    RenderOptions options_;
    PixelFilter filter_;
};

}  // namespace bdpt
