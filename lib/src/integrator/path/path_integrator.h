#pragma once

#include "film/pixel_filter.h"
#include "integrator/contribution_sink.h"
#include "integrator/integrator.h"
#include "path/direct_light.h"
#include "path/fog_sampling.h"

#include <bdpt/render_options.h>

#include <array>
#include <cstddef>
#include <optional>

namespace bdpt {

/// Technique by which a camera path connects its vertex to a point on a light.
enum class LightTechnique : std::size_t {
    light_sample,  ///< next-event estimation at the vertex
    bsdf_sample,   ///< the ray sampled by the BSDF at the vertex hits the light
    fog_sample     ///< the vertex itself was sampled by the light, in fog
};

/// Densities of the techniques in one measure, times their numbers of samples, >= 0; indexed by
/// `LightTechnique`.
using TechniqueDensities = std::array<float, 3>;

/// Returns the weight of the used technique [Veach 1997, sec. 9.2]. The weights of all techniques
/// add up to one.
[[nodiscard]] float mis_weight(const TechniqueDensities& densities, LightTechnique used,
                               Heuristic heuristic);

/// Unidirectional path tracing from the camera. `pt` finds lights by BSDF sampling alone, except
/// delta lights, which BSDF samples cannot hit; `mis` combines BSDF and light sampling by MIS
/// [Veach 1997, ch. 9]; `nee` uses light sampling and drops the emission hit by BSDF samples that
/// light sampling could have found. In fog `mis` and `nee` also sample points by the lights
/// (`FogSampling`).
class PathIntegrator final : public Integrator {
public:
    PathIntegrator(const World& world, const MovingCamera& camera, const RenderOptions& options,
                   const LearnedLight* learned = nullptr);
    [[nodiscard]] RenderStats render_tile(const Tile& tile, SampleRange samples,
                                          const Films& films) const override;

    /// Returns an estimate of the radiance that `first` scatters, by a path from there, as if it
    /// were the first hit of a camera path [nit].
    [[nodiscard]] Rgb radiance_from(SampleContext& sample, const SurfacePoint& first) const;

private:
    struct Ray;
    struct FogArrival;
    struct Walk;
    void add_sample(int x, int y, const ScheduledSample& scheduled, ContributionSink& sink,
                    RenderStats& stats) const;
    void trace_path(SampleContext& sample, Vec2 raster, ContributionSink& sink) const;
    /// Continues a path along its ray, which leads to vertex `depth` + 1, until it ends. Passes
    /// each contribution to `add(Strategy, Contribution)`.
    template <typename Add>
    void follow(SampleContext& sample, Walk walk, int depth, const Add& add) const;
    /// Scatters a path at `point`, its vertex `depth` + 1: adds the direct light there, and samples
    /// the next ray. Returns false if the path ends.
    template <typename Add>
    [[nodiscard]] bool scatter(SampleContext& sample, const SurfacePoint& point,
                               const std::optional<FogArrival>& arrival, int depth, Walk& walk,
                               const Add& add) const;
    /// Passes on light of the path, if paths of its length are asked for.
    template <typename Add>
    void contribute(Strategy strategy, Rgb light, const Walk& walk, const Add& add) const;
    /// Returns the radiance of a light that the ray hit, with its MIS weight against light
    /// sampling; `probability_of_flight` is the probability that no medium scatters the ray before.
    [[nodiscard]] Rgb emission(const Ray& ray, LightId light, const LightPoint& hit, Rgb radiance,
                               float probability_of_flight) const;
    /// Estimates direct light by next-event estimation at the point, which is vertex `depth` + 1 of
    /// the path. Returns the mean of its light samples. `arrival` is set if the point lies in fog.
    [[nodiscard]] Rgb sample_lights(SampleContext& sample, const SurfacePoint& point,
                                    const std::optional<FogArrival>& arrival, int depth) const;
    /// Takes one light sample, by the random point `u`.
    [[nodiscard]] Rgb sample_light(SampleContext& sample, const SurfacePoint& point,
                                   const std::optional<FogArrival>& arrival, int depth,
                                   Vec2 u) const;
    /// Estimates direct light at a point in the fog on the ray, chosen by the light.
    [[nodiscard]] Rgb sample_fog(SampleContext& sample, const Ray& ray, const FogSegment& fog,
                                 int depth) const;
    /// Returns the light of a sampled point on a light at vertex `depth` + 1; black if it is to be
    /// found by other techniques alone.
    [[nodiscard]] DirectLight light_of(const SampleContext& sample, const SurfacePoint& point,
                                       const LightSet::NextEvent& light, int depth) const;
    /// Returns the ratio of the density with which `FogSampling` samples the point in the fog for
    /// the light to that of a walk.
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
    float light_samples_;  // number of light samples
    bool samples_lights_;  // uses light sampling
    std::optional<FogSampling> fog_sampling_;
};

}  // namespace bdpt
