#include "integrator/path/path_integrator.h"

#include "camera/camera.h"
#include "integrator/sample_schedule.h"
#include "math/random_numbers.h"
#include "math/rgb.h"
#include "path/segment_sample.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace bdpt {

float mis_weight(const TechniqueDensities& densities, LightTechnique used, Heuristic heuristic)
{
    const float own = densities[static_cast<std::size_t>(used)];
    if (!(own > 0.0f)) {
        return 0.0f;
    }
    const auto greatest = std::max_element(densities.begin(), densities.end());
    if (heuristic == Heuristic::maximum) {
        const auto first = static_cast<std::size_t>(greatest - densities.begin());
        return static_cast<std::size_t>(used) == first ? 1.0f : 0.0f;
    }
    constexpr float cutoff = 0.1f;  // alpha [Veach 1997, sec. 9.2.3.2]
    if (heuristic == Heuristic::cutoff && own < cutoff * *greatest) {
        return 0.0f;
    }
    // Excludes its own ratio, as its density may be infinite.
    float sum = 1.0f;
    for (std::size_t i = 0; i < densities.size(); ++i) {
        const float density = densities[i];
        if (i == static_cast<std::size_t>(used) ||
            (heuristic == Heuristic::cutoff && density < cutoff * *greatest)) {
            continue;
        }
        const float ratio = density / own;
        sum += heuristic == Heuristic::power     ? ratio * ratio
               : heuristic == Heuristic::uniform ? (density > 0.0f ? 1.0f : 0.0f)
                                                 : ratio;
    }
    return 1.0f / sum;
}

/// Data of a path's arrival at a scattering point in fog.
struct PathIntegrator::FogArrival {
    FogSegment fog;
    float distance = 0.0f;
    float pdf = 0.0f;  ///< density of scattering there [1/m]
};

struct PathIntegrator::Ray {
    SegmentEnd origin;
    Vec3 direction{0.0f};
    SolidAnglePdf pdf;
    /// True if light sampling at the origin, which is `receiver`, could also sample the light that
    /// this ray hits.
    bool competes = false;
    LightSampleContext receiver{};
    std::optional<FogArrival> arrival{};  ///< set if the origin is a scattering point in fog
};

/// A path that is about to trace its next ray.
struct PathIntegrator::Walk {
    Ray ray;
    Rgb beta{1.0f};
    float full = 1.0f;  ///< reference throughput of Russian roulette
    bool dispersed = false;
};

namespace {

/// Returns the receiver for which next-event estimation chooses a light.
LightSampleContext receiver_at(const SurfacePoint& point)
{
    return {.p = point.end.p, .normal = point.bsdf.opaque_normal()};
}

/// Tests whether there is a light that no ray can hit.
bool has_delta_light(const LightSet& lights)
{
    for (std::uint32_t i = 0; i < lights.size(); ++i) {
        if (lights[LightId{i}].is_delta()) {
            return true;
        }
    }
    return false;
}

}  // namespace

PathIntegrator::PathIntegrator(const World& world, const MovingCamera& camera,
                               const RenderOptions& options, const LearnedLight* learned)
    : world_(world),
      camera_(camera),
      options_(options),
      schedule_(options_),
      filter_(options.film.filter),
      // Only in `mis` does BSDF sampling find the light that light sampling omits.
      next_event_sampling_{
          .environments = options.integrator == IntegratorKind::mis ? options.sampling.environment
                                                                    : EnvironmentSampling::plain,
          .lights = options.sampling.lights,
          .samples = options.sampling.light_samples,
          .learned = options.integrator == IntegratorKind::mis ? learned : nullptr},
      light_samples_(static_cast<float>(options.sampling.light_samples)),
      samples_lights_(options.integrator != IntegratorKind::pt || has_delta_light(world.lights()))
{
    if (options.integrator != IntegratorKind::pt && world.media().fog() != MediumId::clear) {
        fog_sampling_.emplace(world, options.sampling.lights);
    }
}

RenderStats PathIntegrator::render_tile(const Tile& tile, SampleRange samples,
                                        const Films& films) const
{
    RenderStats stats;
    ContributionSink sink(films, filter_, nullptr, 0);
    for (int y = tile.y_begin; y < tile.y_end; ++y) {
        for (int x = tile.x_begin; x < tile.x_end; ++x) {
            schedule_.for_each(x, y, samples, [&](const ScheduledSample& scheduled) {
                add_sample(x, y, scheduled, sink, stats);
            });
        }
    }
    return stats;
}

void PathIntegrator::add_sample(int x, int y, const ScheduledSample& scheduled,
                                ContributionSink& sink, RenderStats& stats) const
{
    const SampleStart start(options_, filter_, world_, camera_, x, y, scheduled.index);
    const TimedCamera camera(camera_, start.moment.time);
    SampleContext sample = start.context(world_, camera.get(), stats.rays);
    sink.begin_sample(x, y, scheduled);
    trace_path(sample, start.raster, sink);
    sink.end_sample();
    ++stats.paths.camera;
}

void PathIntegrator::trace_path(SampleContext& sample, Vec2 raster, ContributionSink& sink) const
{
    Sampler& sampler = sample.sampler;
    const Camera& camera = sample.camera;
    sampler.start(SampleUse::lens);
    const Vec2 u_lens = camera.has_finite_lens() ? sampler.next_2d() : Vec2(0.0f);
    const CameraRay first = camera.generate_ray(raster, u_lens);
    follow(
        sample,
        {.ray = {.origin = first.lens, .direction = first.direction, .pdf = first.pdf_direction}},
        1, [&](Strategy strategy, const Contribution& found) {
            sink.add(sample, strategy, found, 1.0f);
        });
}

Rgb PathIntegrator::radiance_from(SampleContext& sample, const SurfacePoint& first) const
{
    Rgb sum(0.0f);
    const auto add = [&](Strategy /*strategy*/, const Contribution& found) {
        sum += found.dispersed ? found.unweighted * spectral_weight(sample.wavelength)
                               : found.unweighted;
    };
    Walk walk;
    if (scatter(sample, first, std::nullopt, 1, walk, add)) {
        follow(sample, walk, 2, add);
    }
    return sum;
}

template <typename Add>
void PathIntegrator::follow(SampleContext& sample, Walk walk, int depth, const Add& add) const
{
    const auto found = [&](int s, Rgb light) {
        contribute({.s = s, .t = depth + 1}, light, walk, add);
    };
    for (; depth <= options_.transport.max_depth; ++depth) {
        const Ray& ray = walk.ray;
        ++sample.rays.camera;
        const SegmentKey segment = sample.segment(0, depth);
        const SegmentSample event =
            sample_segment(sample, ray.origin, ray.direction, segment,
                           {.from_camera = true, .vertices = depth, .beta = walk.beta});
        std::optional<FogArrival> arrival;
        if (event.fog && fog_sampling_) {
            const FogSegment fog{ray.origin.p, ray.direction, *event.fog};
            if (depth < options_.transport.max_depth && depth + 1 >= options_.transport.min_depth) {
                found(1, walk.beta * sample_fog(sample, ray, fog, depth));
            }
            if (event.in_medium) {
                arrival = {fog, event.in_medium->distance, event.transmission.pdf_scatter};
            }
        }
        if (event.is_nothing()) {
            const auto id = world_.lights().environment();
            const bool visible =
                depth > 1 || options_.transport.background == Background::environment;
            if (id && visible) {
                const auto& light = std::get<EnvironmentLight>(world_.lights()[*id].model());
                found(0, walk.beta * event.weight() *
                             emission(ray, *id, {.p = ray.direction}, light.radiance(ray.direction),
                                      event.probability()));
            }
            return;
        }
        SurfacePoint point = make_interaction(sample, event, ray.origin, ray.direction, segment);
        if (depth == 1) {
            point.bsdf.see_from_lens();
        }
        const Vec3 along = point.end.p - ray.origin.p;
        const float distance_squared = dot(along, along);
        if (distance_squared < coincident) {
            return;
        }
        walk.beta *= event.weight();
        if (point.light) {
            const LightPoint on_light{.p = point.end.p,
                                      .ng = point.end.ng,
                                      .barycentrics = point.barycentrics,
                                      .time = sample.time};
            found(0, walk.beta * emission(ray, *point.light, on_light, point.emission,
                                          event.probability()));
        }
        if (depth == options_.transport.max_depth ||
            !scatter(sample, point, arrival, depth, walk, add)) {
            return;
        }
    }
}

template <typename Add>
bool PathIntegrator::scatter(SampleContext& sample, const SurfacePoint& point,
                             const std::optional<FogArrival>& arrival, int depth, Walk& walk,
                             const Add& add) const
{
    walk.dispersed = walk.dispersed || point.disperses;
    if (samples_lights_ && point.bsdf.connectible() && depth + 1 >= options_.transport.min_depth) {
        contribute({.s = 1, .t = depth + 1},
                   walk.beta * sample_lights(sample, point, arrival, depth), walk, add);
    }
    Sampler& sampler = sample.sampler;
    sampler.start(SampleUse::camera_walk, static_cast<std::uint32_t>(depth + 1));
    const Vec2 u_direction = sampler.next_2d();
    const float u_lobe = point.bsdf.has_one_lobe() ? 0.0f : sampler.next_1d();
    const auto scattered = point.bsdf.sample(u_lobe, u_direction, TransportMode::radiance);
    walk.beta = scattered ? walk.beta * scattered->weight : Rgb(0.0f);
    if (is_black(walk.beta)) {
        return false;
    }
    Ray& ray = walk.ray;
    ray.origin = point.end;
    ray.arrival = arrival;
    ray.direction = scattered->wi;
    ray.pdf = scattered->pdf_fwd;
    ray.competes = !scattered->delta && options_.integrator != IntegratorKind::pt;
    if (ray.competes) {
        ray.receiver = receiver_at(point);
    }
    // The reference is the throughput after the first hit, so that dark surfaces are not starved.
    walk.full = depth == 1 ? max_component(walk.beta) : walk.full;
    return depth < options_.transport.rr_start ||
           survives(walk.beta, walk.full, options_.transport.rr_survival, sampler);
}

template <typename Add>
void PathIntegrator::contribute(Strategy strategy, Rgb light, const Walk& walk,
                                const Add& add) const
{
    if (strategy.s + strategy.t > options_.transport.min_depth && !is_black(light)) {
        add(strategy, {.unweighted = light, .dispersed = walk.dispersed});
    }
}

float PathIntegrator::fog_density_ratio(const std::optional<FogArrival>& arrival,
                                        LightId light) const
{
    return arrival ? fog_sampling_->samples() *
                         fog_sampling_->pdf(arrival->fog, light, arrival->distance) / arrival->pdf
                   : 0.0f;
}

Rgb PathIntegrator::emission(const Ray& ray, LightId light, const LightPoint& hit, Rgb radiance,
                             float probability_of_flight) const
{
    if (!ray.competes || is_black(radiance)) {
        return radiance;
    }
    const LightSet& lights = world_.lights();
    const float by_light =
        lights.next_event_pdf(light, hit, ray.receiver, next_event_sampling_).value *
        light_samples_;
    const float by_fog =
        ray.arrival ? lights[light]
                              .pdf_incident(ray.receiver, hit, next_event_sampling_.environments)
                              .value *
                          fog_density_ratio(ray.arrival, light)
                    : 0.0f;
    if (options_.integrator == IntegratorKind::nee) {
        return by_light + by_fog > 0.0f ? Rgb(0.0f) : radiance;
    }
    const Vec3 along = hit.p - ray.origin.p;
    const float by_bsdf =
        probability_of_flight *
        (lights[light].is_infinite()
             ? ray.pdf.value
             : to_area(ray.pdf, std::abs(dot(hit.ng, ray.direction)), dot(along, along)).value);
    return radiance * weight({by_light, by_bsdf, by_fog}, LightTechnique::bsdf_sample);
}

Rgb PathIntegrator::sample_lights(SampleContext& sample, const SurfacePoint& point,
                                  const std::optional<FogArrival>& arrival, int depth) const
{
    sample.sampler.start(SampleUse::next_event, static_cast<std::uint32_t>(depth + 1));
    const Vec2 u = sample.sampler.next_2d();
    const auto count = static_cast<std::uint32_t>(next_event_sampling_.samples);
    Rgb sum = sample_light(sample, point, arrival, depth, u);
    for (std::uint32_t i = 1; i < count; ++i) {
        sum += sample_light(sample, point, arrival, depth, shifted_point(u, i, count));
    }
    return sum / light_samples_;
}

Rgb PathIntegrator::sample_light(SampleContext& sample, const SurfacePoint& point,
                                 const std::optional<FogArrival>& arrival, int depth, Vec2 u) const
{
    Sampler& sampler = sample.sampler;
    const LightSet& lights = world_.lights();
    const auto next = lights.sample_next_event(
        receiver_at(point), u, [&sampler] { return sampler.next_fine(); }, next_event_sampling_,
        sample.time);
    if (!next.incident) {
        return Rgb(0.0f);
    }
    const DirectLight found = light_of(sample, point, next, depth);
    if (is_black(found.value)) {
        return found.value;
    }
    const float pdf = next.incident->pdf_solid_angle.value;
    const TechniqueDensities densities{pdf * (next.probability * light_samples_), found.bsdf_pdf,
                                       pdf * fog_density_ratio(arrival, next.light)};
    return found.value * weight(densities, LightTechnique::light_sample);
}

Rgb PathIntegrator::sample_fog(SampleContext& sample, const Ray& ray, const FogSegment& fog,
                               int depth) const
{
    Sampler& sampler = sample.sampler;
    sampler.start(SampleUse::fog, static_cast<std::uint32_t>(depth));
    const Vec2 u_light = sampler.next_2d();
    const float u_distance = sampler.next_1d();
    const float samples = fog_sampling_->samples();
    if (sampler.next_1d() >= samples) {
        return Rgb(0.0f);
    }
    const auto chosen =
        fog_sampling_->sample(fog, u_light, u_distance, [&sampler] { return sampler.next_fine(); });
    if (!chosen) {
        return Rgb(0.0f);
    }
    const SurfacePoint point = world_.medium_point(
        ray.origin, ray.direction, {.distance = chosen->distance, .medium = world_.media().fog()});
    const Light& light = world_.lights()[chosen->light];
    const LightSampleContext receiver = receiver_at(point);
    const auto incident =
        light.sample_incident(receiver, chosen->u, next_event_sampling_.environments, sample.time);
    if (!incident) {
        return Rgb(0.0f);
    }
    const DirectLight found = light_of(
        sample, point, {.light = chosen->light, .probability = 1.0f, .incident = incident}, depth);
    if (is_black(found.value)) {
        return found.value;
    }
    const SegmentTransmission transmission =
        world_.media().transmission(ray.origin, point.end, ray.direction, chosen->distance);
    const SegmentKey segment = sample.segment(0, depth);
    Rgb through =
        world_.volumes().transmittance(ray.origin.p, ray.direction, chosen->distance, segment);
    if (world_.has_tinted_surfaces()) {
        through *= world_.tint(ray.origin, ray.direction, chosen->distance, segment);
    }
    const float probability =
        world_.lights().context_probability(chosen->light, receiver, next_event_sampling_.lights);
    const float pdf = incident->pdf_solid_angle.value;
    const TechniqueDensities densities{
        transmission.pdf_scatter * pdf * (probability * light_samples_),
        transmission.pdf_scatter * found.bsdf_pdf, samples * chosen->pdf * pdf};
    return found.value * transmission.transmittance * through *
           (weight(densities, LightTechnique::fog_sample) / (samples * chosen->pdf));
}

DirectLight PathIntegrator::light_of(const SampleContext& sample, const SurfacePoint& point,
                                     const LightSet::NextEvent& light, int depth) const
{
    if (options_.integrator == IntegratorKind::pt && !world_.lights()[light.light].is_delta()) {
        return {};
    }
    DirectLight found =
        direct_light(sample, point.end, point.bsdf, light, sample.segment(1, depth + 1));
    if (options_.integrator == IntegratorKind::nee) {
        found.bsdf_pdf = 0.0f;
    }
    return found;
}

}  // namespace bdpt
