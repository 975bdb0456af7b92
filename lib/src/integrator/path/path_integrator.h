#pragma once

#include "film/pixel_filter.h"
#include "integrator/contribution_sink.h"
#include "integrator/integrator.h"
#include "integrator/path/light_techniques.h"
#include "path/fog_sampling.h"

#include <optional>

namespace bdpt {

/// Unidirectional path tracing from the camera. `pt` finds lights by BSDF sampling alone, except
/// delta lights, which no such sample can hit; `mis` weighs BSDF sampling and light sampling [Veach
/// 1997, ch. 9]; `nee` takes light sampling and drops the light of BSDF samples that light sampling
/// could have found. In fog `mis` and `nee` also choose points for the lights (`FogSampling`).
class PathIntegrator final : public Integrator {
public:
    PathIntegrator(const World& world, const MovingCamera& camera, const RenderOptions& options,
                   const EnvironmentVisibility* visibility = nullptr);
    [[nodiscard]] RenderStats render_tile(const Tile& tile, SampleRange samples,
                                          const Films& films) const override;

private:
    struct Ray;
    struct FogArrival;
    struct LightConnection;
    void add_sample(int x, int y, const ScheduledSample& scheduled, const Films& films,
                    ContributionSink& sink, RenderStats& stats) const;
    void trace_path(SampleContext& sample, Vec2 raster, ContributionSink& sink) const;
    /// Radiance that the ray brings from a light it hit, weighed against light sampling;
    /// `probability_of_flight` is that of no medium scattering it on its way.
    [[nodiscard]] Rgb emission(const Ray& ray, LightId light, const LightPoint& hit, Rgb radiance,
                               float probability_of_flight) const;
    /// Next-event estimation at the point, which is vertex `depth` + 1 of the path. Returns the
    /// mean of its light samples. `arrival` is set if the point lies in fog.
    [[nodiscard]] Rgb sample_lights(SampleContext& sample, const SurfacePoint& point,
                                    const std::optional<FogArrival>& arrival, int depth) const;
    /// One of them, by the random point `u`.
    [[nodiscard]] Rgb sample_light(SampleContext& sample, const SurfacePoint& point,
                                   const std::optional<FogArrival>& arrival, int depth,
                                   Vec2 u) const;
    /// Next-event estimation at a point of the fog on the ray, chosen for the light.
    [[nodiscard]] Rgb sample_fog(SampleContext& sample, const Ray& ray, const FogSegment& fog,
                                 int depth) const;
    /// Light that arrives from a sampled point of the light; nothing if none does.
    [[nodiscard]] std::optional<LightConnection> connect(SampleContext& sample,
                                                         const SurfacePoint& point,
                                                         const Light& light,
                                                         const IncidentSample& incident,
                                                         int depth) const;
    /// How much more often `FogSampling` finds the light at the point of fog than a walk comes
    /// there.
    [[nodiscard]] float fog_density_ratio(const std::optional<FogArrival>& arrival,
                                          LightId light) const;
    [[nodiscard]] float weight(const TechniqueDensities& densities, LightTechnique used) const
    {
        return mis_weight(densities, used, options_.transport.heuristic);
    }

    const World& world_;
    const MovingCamera& camera_;
    RenderOptions options_;
    SampleSchedule schedule_;
    PixelFilter filter_;
    NextEventSampling next_event_sampling_;
    float light_samples_;  // of these
    bool samples_lights_;  // at all
    std::optional<FogSampling> fog_sampling_;
};

}  // namespace bdpt
