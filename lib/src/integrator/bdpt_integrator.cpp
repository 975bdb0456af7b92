#include "integrator/bdpt_integrator.h"

#include "camera/moving_camera.h"
#include "integrator/sample_start.h"
#include "integrator/sample_timer.h"
#include "math/sampler.h"
#include "path/random_walk.h"
#include "scene/world.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace bdpt {

namespace {

/// Light paths of one sample after the first have random numbers of their own.
Sampler light_sampler(const RenderOptions& options, const Sampler& first, int x, int y,
                      std::int64_t index, int light_path)
{
    constexpr std::uint64_t odd = 0xd1342543de82ef95U;  // spreads consecutive seeds
    const auto number = static_cast<std::uint64_t>(light_path);
    if (light_path == 0) {
        return first;
    }
    Sampler own(options.sampler, options.seed + number * odd, x, y, index);
    own.set_wavelength(first.wavelength());
    own.set_time(first.time());
    return own;
}

}  // namespace

BdptIntegrator::BdptIntegrator(const World& world, const MovingCamera& camera,
                               const RenderOptions& options)
    : world_(world),
      camera_(camera),
      options_(options),
      filter_(options.filter),
      strategies_(options)
{}

RenderStats BdptIntegrator::render_tile(const Tile& tile, SampleRange samples,
                                        const Films& films) const
{
    Scratch scratch{.light_path = Subpath(strategies_.light_vertices()),
                    .camera_path = Subpath(strategies_.camera_vertices()),
                    .weigher = PathWeigher(world_, camera_.first(), strategies_, options_.heuristic,
                                           options_.max_depth + 1),
                    .splats = {},
                    .stats = {}};
    // One for each strategy with t <= 1.
    scratch.splats.reserve(
        2 * static_cast<std::size_t>(strategies_.light_vertices() * options_.light_paths) + 2);
    if (films.on_path) {
        scratch.weigher.keep_paths();
    }
    for (int y = tile.y_begin; y < tile.y_end; ++y) {
        for (int x = tile.x_begin; x < tile.x_end; ++x) {
            for (std::int64_t index = samples.begin; index < samples.end; ++index) {
                SampleTimer timer(films.times, x, y, index);
                if (PhaseClock* clock = timer.clock()) {
                    add_sample({.x = x, .y = y, .index = index}, films, scratch, *clock);
                } else {
                    NoProbe probe;
                    add_sample({.x = x, .y = y, .index = index}, films, scratch, probe);
                }
            }
        }
    }
    return scratch.stats;
}

template <typename Probe>
void BdptIntegrator::add_sample(const SampleId& id, const Films& films, Scratch& scratch,
                                Probe& probe) const
{
    const auto [x, y, index] = id;
    Sampler sampler(options_.sampler, options_.seed, x, y, index);
    const Vec2 center(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
    const Vec2 raster = start_sample(sampler, filter_, world_, camera_, x, y);
    const TimedCamera timed(camera_, sampler.time());
    const Camera& camera = timed.get();
    Sample sample{
        .index = index, .sampler = sampler, .camera = camera, .films = films, .pixel = center};
    scratch.weigher.set_time(sampler.time());
    // Light paths outside of a crop can splat into it.
    const bool wanted = films.film.region().contains(x, y);
    const int camera_vertices = wanted ? strategies_.camera_vertices() : 1;
    trace_camera_subpath(world_, camera, raster,
                         {.max_vertices = camera_vertices, .rr_start = options_.rr_start}, sampler,
                         scratch.camera_path, probe);
    probe.enter(Phase::weigh);
    scratch.weigher.begin_camera_path(scratch.camera_path.all());
    scratch.stats.rays.camera += scratch.camera_path.rays();
    probe.enter(Phase::connect);
    Rgb radiance = wanted ? estimate_camera_path(sample, scratch, probe) : Rgb(0.0f);
    splat_light(sample, scratch, probe);
    const WalkLimits light_limits{.max_vertices = strategies_.light_vertices(),
                                  .rr_start = options_.rr_start};
    for (int i = 0; i < options_.light_paths; ++i) {
        probe.enter(Phase::walk);
        Sampler own = light_sampler(options_, sampler, x, y, index, i);
        Sample light_sample{
            .index = index, .sampler = own, .camera = camera, .films = films, .pixel = center};
        trace_light_subpath(world_, camera, light_limits, strategies_.next_event_sampling(), own,
                            scratch.light_path, probe);
        probe.enter(Phase::weigh);
        scratch.weigher.begin_light_path(scratch.light_path.all());
        scratch.stats.rays.light += scratch.light_path.rays();
        ++scratch.stats.paths.light;
        probe.enter(Phase::connect);
        splat_light_path(light_sample, scratch, probe);
        radiance += join_paths(light_sample, scratch, probe);
    }
    probe.enter(Phase::splat);
    if (wanted) {
        ++scratch.stats.paths.camera;
        films.film.add_sample(x, y, index, radiance);
    }
    add_pending_splats(sample, scratch);
}

template <typename Probe>
Rgb BdptIntegrator::estimate_camera_path(Sample& sample, Scratch& scratch, Probe& probe) const
{
    Rgb radiance(0.0f);
    const auto add = [&](Strategy strategy, const std::optional<Contribution>& found) {
        if (found) {
            radiance += measure(strategy, *found, sample, scratch, probe);
            probe.enter(Phase::connect);
        }
    };
    for (int t = 2; t <= scratch.camera_path.size(); ++t) {
        const auto camera = scratch.camera_path.first(t);
        if (strategies_.uses(0, t)) {
            add({.s = 0, .t = t}, hit_light(world_, camera, scratch.weigher, probe));
        }
        if (t <= options_.max_depth && strategies_.uses(1, t)) {
            add({.s = 1, .t = t}, connect_to_light(world_, camera, sample.sampler, scratch.weigher,
                                                   scratch.stats.rays, probe));
        }
    }
    return radiance;
}

template <typename Probe>
Rgb BdptIntegrator::join_paths(const Sample& sample, Scratch& scratch, Probe& probe) const
{
    Rgb radiance(0.0f);
    for (int t = 2; t <= scratch.camera_path.size(); ++t) {
        const int longest_s = std::min(scratch.light_path.size(), options_.max_depth + 1 - t);
        for (int s = 2; s <= longest_s; ++s) {
            if (!strategies_.uses(s, t)) {
                continue;
            }
            const auto found = connect_interior(
                world_, scratch.light_path.first(s), scratch.camera_path.first(t),
                sample.sampler.segment_key(s, t), scratch.weigher, scratch.stats.rays, probe);
            if (found) {
                radiance += measure({.s = s, .t = t}, *found, sample, scratch, probe);
                probe.enter(Phase::connect);
            }
        }
    }
    return radiance;
}

template <typename Probe>
void BdptIntegrator::splat_light_path(Sample& sample, Scratch& scratch, Probe& probe) const
{
    Subpath& path = scratch.light_path;
    const int longest_s = std::min(path.size(), options_.max_depth);
    for (int s = 2; s <= longest_s; ++s) {
        if (!strategies_.uses(s, 1)) {
            continue;
        }
        const auto splat = connect_to_lens(world_, sample.camera, path.first(s), sample.sampler,
                                           scratch.weigher, scratch.stats.rays, probe);
        if (splat) {
            add_splat({.s = s, .t = 1}, *splat, static_cast<std::uint32_t>(2 * s), sample, scratch,
                      probe);
            probe.enter(Phase::connect);
        }
    }
    for (const LensCrossing& crossing : path.crossings()) {
        const int s = crossing.light_vertices + 1;
        if (s > options_.max_depth + 1 || !strategies_.uses(s, 0)) {
            continue;
        }
        if (const auto splat = hit_lens(world_, path, crossing, scratch.weigher, probe)) {
            add_splat({.s = s, .t = 0}, *splat, static_cast<std::uint32_t>(2 * s + 1), sample,
                      scratch, probe);
            probe.enter(Phase::connect);
        }
    }
}

template <typename Probe>
void BdptIntegrator::splat_light(Sample& sample, Scratch& scratch, Probe& probe) const
{
    if (!strategies_.uses(1, 1) || !sample.camera.is_perspective()) {
        return;
    }
    const auto splat = connect_light_to_lens(world_, sample.camera, sample.sampler, scratch.weigher,
                                             scratch.stats.rays, probe);
    if (splat) {
        add_splat({.s = 1, .t = 1}, *splat, 1, sample, scratch, probe);
    }
}

Rgb BdptIntegrator::spectrum(Strategy strategy, const Sample& sample, const Scratch& scratch) const
{
    // Vertices of the two subpaths; a point that is sampled on a light or the lens is in neither.
    const int light = strategy.t == 0 ? strategy.s - 1 : strategy.s > 1 ? strategy.s : 0;
    const int camera = strategy.t > 1 ? strategy.t : 0;
    const bool dispersed = (light > 0 && scratch.light_path.first(light).back().dispersed) ||
                           (camera > 0 && scratch.camera_path.first(camera).back().dispersed);
    return dispersed ? spectral_weight(sample.sampler.wavelength()) : Rgb(1.0f);
}

template <typename Probe>
Rgb BdptIntegrator::measure(Strategy strategy, const Contribution& found, const Sample& sample,
                            Scratch& scratch, Probe& probe) const
{
    const float count = strategies_.count(strategy.s, strategy.t);
    const Rgb unweighted = world_.disperses()
                               ? found.unweighted * spectrum(strategy, sample, scratch)
                               : found.unweighted;
    const Rgb weighted = found.weight / count * unweighted;
    if (!sample.films.strategies.empty()) {
        probe.enter(Phase::splat);
        sample.films.strategies.add(strategy, sample.pixel,
                                    {.weighted = weighted, .unweighted = unweighted / count});
    }
    if (sample.films.on_path) {
        sample.films.on_path({.strategy = strategy,
                              .raster = sample.pixel,
                              .unweighted = unweighted / count,
                              .weight = found.weight,
                              .shares = scratch.weigher.shares()});
    }
    return weighted;
}

void BdptIntegrator::add_pending_splats(const Sample& sample, Scratch& scratch)
{
    for (const PendingSplat& splat : scratch.splats) {
        sample.films.film.add_splat(splat.raster, sample.index, splat.radiance);
    }
    scratch.splats.clear();
}

template <typename Probe>
void BdptIntegrator::add_splat(Strategy strategy, const Splat& splat, std::uint32_t dimension,
                               Sample& sample, Scratch& scratch, Probe& probe) const
{
    probe.enter(Phase::splat);
    SplatTarget target{.raster = splat.raster};
    if (!filter_.is_pixel()) {
        sample.sampler.start(SampleUse::film, dimension);
        target = filter_.choose_pixel(splat.raster, sample.sampler.next_2d());
    }
    const float count = strategies_.count(strategy.s, strategy.t);
    const float mis_weight = splat.contribution.weight;
    Rgb unweighted = splat.contribution.unweighted;
    if (world_.disperses()) {
        unweighted *= spectrum(strategy, sample, scratch);
    }
    const Rgb weighted = target.weight * mis_weight / count * unweighted;
    sample.films.film.prefetch_splat(target.raster, sample.index);
    scratch.splats.push_back({.raster = target.raster, .radiance = weighted});
    if (!sample.films.strategies.empty()) {
        sample.films.strategies.add(
            strategy, target.raster,
            {.weighted = weighted, .unweighted = target.weight / count * unweighted});
    }
    if (!sample.films.on_path) {
        return;
    }
    const auto x = static_cast<int>(std::floor(target.raster.x));
    const auto y = static_cast<int>(std::floor(target.raster.y));
    if (sample.films.film.region().contains(x, y)) {
        sample.films.on_path({.strategy = strategy,
                              .raster = target.raster,
                              .unweighted = target.weight / count * unweighted,
                              .weight = mis_weight,
                              .shares = scratch.weigher.shares()});
    }
}

}  // namespace bdpt
