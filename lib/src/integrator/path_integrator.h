#pragma once

#include "camera/pixel_filter.h"
#include "integrator/integrator.h"

#include "scene/world.h"

namespace bdpt {

class Camera;
class Sampler;

/// Path tracing from the camera. `pt` finds lights by BSDF sampling alone, but for delta lights,
/// which no such sample can hit; `mis` weighs BSDF sampling and light sampling [Veach 1997, ch. 9];
/// `nee` takes light sampling and drops what BSDF sampling finds that it could have found.
class PathIntegrator final : public Integrator {
public:
    PathIntegrator(const World& world, const MovingCamera& camera, const RenderOptions& options);
    [[nodiscard]] RenderStats render_tile(const Tile& tile, SampleRange samples,
                                          const Films& films) const override;
    [[nodiscard]] bool splats() const override { return false; }

private:
    struct Ray;
    /// The sample at work.
    struct Sample {
        Vec2 pixel;   // centre [pixels]
        Vec2 raster;  // where the camera ray goes through [pixels]
        Sampler& sampler;
        const Camera& camera;  // at its time
        const Films& films;
        RayCounts& rays;
    };
    /// Here and below the probe is told what is being done.
    template <typename Probe>
    [[nodiscard]] Rgb estimate(Sample& sample, Probe& probe) const;
    /// Radiance that the ray brings from a light it hit, weighed against light sampling.
    [[nodiscard]] Rgb emission(const Ray& ray, LightId light, const LightPoint& hit,
                               Rgb radiance) const;
    template <typename Probe>
    [[nodiscard]] Rgb sample_light(const SurfacePoint& point, SegmentKey segment, Sampler& sampler,
                                   RayCounts& rays, Probe& probe) const;
    /// Weights of a light sample and of a BSDF sample that find the same point of a light, by their
    /// densities.
    [[nodiscard]] float light_weight(float light_pdf, float bsdf_pdf) const;
    [[nodiscard]] float bsdf_weight(float bsdf_pdf, float light_pdf) const;

    const World& world_;
    const MovingCamera& camera_;
    RenderOptions options_;
    PixelFilter filter_;
    NextEventSampling next_event_sampling_;
};

}  // namespace bdpt
