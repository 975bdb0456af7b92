#pragma once

#include "film/pixel_filter.h"
#include "integrator/contribution_sink.h"
#include "integrator/integrator.h"

namespace bdpt {

/// Path tracing from the camera. `pt` finds lights by BSDF sampling alone, but for delta lights,
/// which no such sample can hit; `mis` weighs BSDF sampling and light sampling [Veach 1997, ch. 9];
/// `nee` takes light sampling and drops what BSDF sampling finds that it could have found.
class PathIntegrator final : public Integrator {
public:
    PathIntegrator(const World& world, const MovingCamera& camera, const RenderOptions& options);
    [[nodiscard]] RenderStats render_tile(const Tile& tile, SampleRange samples,
                                          const Films& films) const override;

private:
    struct Ray;
    void add_sample(int x, int y, const ScheduledSample& scheduled, const Films& films,
                    ContributionSink& sink, RenderStats& stats) const;
    void trace_path(SampleContext& sample, Vec2 raster, ContributionSink& sink) const;
    /// Radiance that the ray brings from a light it hit, weighed against light sampling;
    /// `probability_of_flight` is that of no medium scattering it on its way.
    [[nodiscard]] Rgb emission(const Ray& ray, LightId light, const LightPoint& hit, Rgb radiance,
                               float probability_of_flight) const;
    /// Next-event estimation at the point, which is vertex `depth` + 1 of the path: the mean of
    /// its light samples.
    [[nodiscard]] Rgb sample_lights(SampleContext& sample, const SurfacePoint& point,
                                    int depth) const;
    /// One of them, by the random point `u`.
    [[nodiscard]] Rgb sample_light(SampleContext& sample, const SurfacePoint& point, int depth,
                                   Vec2 u) const;
    /// Weights of a light sample and of a BSDF sample that find the same point of a light, by their
    /// densities.
    [[nodiscard]] float light_weight(float light_pdf, float bsdf_pdf) const;
    [[nodiscard]] float bsdf_weight(float bsdf_pdf, float light_pdf) const;

    const World& world_;
    const MovingCamera& camera_;
    RenderOptions options_;
    SampleSchedule schedule_;
    PixelFilter filter_;
    NextEventSampling next_event_sampling_;
    float light_samples_;  // of these
};

}  // namespace bdpt
