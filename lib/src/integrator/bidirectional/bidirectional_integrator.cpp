#include "integrator/bidirectional/bidirectional_integrator.h"

#include "camera/moving_camera.h"
#include "integrator/sample_start.h"
#include "math/shifted_points.h"
#include "path/merge.h"
#include "profile/sample_timer.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace bdpt {

struct BidirectionalIntegrator::Scratch {
    Subpath light_path;
    Subpath camera_path;
    std::unique_ptr<PathWeigher> weigher;  // the sink knows its address
    ContributionSink sink;
    RenderStats stats{};
};

namespace {

/// Light paths of one sample after the first have random numbers of their own.
Sampler light_sampler(const RenderOptions& options, int x, int y, std::int64_t index,
                      int light_path)
{
    constexpr std::uint64_t odd = 0xd1342543de82ef95U;  // spreads consecutive seeds
    return {options.sampling.sampler,
            options.sampling.seed + static_cast<std::uint64_t>(light_path) * odd, x, y, index};
}

}  // namespace

BidirectionalIntegrator::BidirectionalIntegrator(const World& world, const MovingCamera& camera,
                                                 const RenderOptions& options)
    : world_(world),
      camera_(camera),
      options_(options),
      schedule_(options_),
      filter_(options.film.filter),
      strategies_(options),
      cache_(LightPathCounts(options), options)
{}

std::int64_t BidirectionalIntegrator::most_samples_in_pass() const
{
    return cache_.counts().shared ? 1 : Integrator::most_samples_in_pass();
}

BidirectionalIntegrator::Scratch BidirectionalIntegrator::make_scratch(const Films& films) const
{
    // One splat for each strategy with t <= 1.
    const int own_paths = cache_.counts().shared ? 1 : static_cast<int>(strategies_.light_paths());
    const auto most_splats =
        static_cast<std::size_t>(2 * strategies_.light_vertices() * own_paths + 2);
    auto weigher = std::make_unique<PathWeigher>(
        world_, camera_.first(), strategies_, options_.transport.heuristic,
        options_.transport.max_depth + 1, merging_.weight());
    if (films.on_path) {
        weigher->keep_paths();
    }
    ContributionSink sink(films, filter_, weigher.get(), most_splats);
    return Scratch{.light_path = Subpath(strategies_.light_vertices()),
                   .camera_path = Subpath(strategies_.camera_vertices()),
                   .weigher = std::move(weigher),
                   .sink = std::move(sink)};
}

std::int64_t BidirectionalIntegrator::begin_pass(SampleRange samples)
{
    merging_ = Merging(options_, cache_.counts(), world_.bounding_sphere(), samples.begin);
    return cache_.counts().shared ? cache_.chunks() : 0;
}

void BidirectionalIntegrator::end_parts()
{
    if (cache_.counts().merged) {
        grid_.build(cache_, world_.bounding_sphere().center, merging_.radius);
    }
}

RenderStats BidirectionalIntegrator::render_tile(const Tile& tile, SampleRange samples,
                                                 const Films& films) const
{
    Scratch scratch = make_scratch(films);
    for (int y = tile.y_begin; y < tile.y_end; ++y) {
        for (int x = tile.x_begin; x < tile.x_end; ++x) {
            schedule_.for_each(x, y, samples, [&](const ScheduledSample& scheduled) {
                SampleTimer timer(films.times, x, y, scheduled.index);
                add_sample(x, y, scheduled, timer.clock(), scratch);
            });
        }
    }
    return scratch.stats;
}

void BidirectionalIntegrator::add_sample(int x, int y, const ScheduledSample& scheduled,
                                         PhaseClock* clock, Scratch& scratch) const
{
    ContributionSink& sink = scratch.sink;
    const std::int64_t index = scheduled.index;
    SampleStart start(options_, filter_, world_, camera_, x, y, index);
    LightPathCache::Choice shared;
    if (cache_.counts().shared) {
        shared = cache_.choose(x, y, scheduled);
        start.moment = cache_.moment(shared.bundle);
    }
    const TimedCamera camera(camera_, start.moment.time);
    SampleContext sample{.world = world_,
                         .camera = camera.get(),
                         .sampler = start.sampler,
                         .time = start.moment.time,
                         .wavelength = start.moment.wavelength,
                         .rays = scratch.stats.rays,
                         .clock = clock};
    sink.begin_sample(x, y, scheduled);

    // Own light paths of pixels outside of a crop can splat into it.
    const bool wanted = sink.holds_pixel();
    trace_camera_subpath(sample, start.raster,
                         {.max_vertices = wanted ? strategies_.camera_vertices() : 1,
                          .rr_start = options_.transport.rr_start,
                          .rr_survival = options_.transport.rr_survival},
                         scratch.camera_path);
    sample.enter(Phase::weigh);
    scratch.weigher->begin_camera_path(scratch.camera_path.all());
    sample.enter(Phase::connect);
    join_camera_path(sample, scratch);
    if (strategies_.uses(1, 1) && sample.camera.is_perspective()) {
        if (const auto splat = connect_light_to_lens(sample, *scratch.weigher)) {
            sink.splat(sample, {.s = 1, .t = 1}, *splat, strategies_.count(1, 1), 1);
        }
    }
    for (int i = 0; i < shared.count; ++i) {
        sink.begin_joins(i);
        join_paths(sample, cache_.path(shared, i), scratch);
    }
    if (cache_.counts().merged) {
        merge_paths(sample, scratch);
    }
    const int own_paths = cache_.counts().shared ? 0 : static_cast<int>(strategies_.light_paths());
    for (int i = 0; i < own_paths; ++i) {
        if (i > 0) {
            sample.sampler = light_sampler(options_, x, y, index, i);
        }
        sink.begin_joins(i);
        trace_light_path(sample, scratch);
        join_paths(sample, scratch.light_path.all(), scratch);
    }
    sample.enter(Phase::splat);
    scratch.stats.paths.camera += wanted ? 1U : 0U;
    sink.end_sample();
}

RenderStats BidirectionalIntegrator::do_part(std::int64_t chunk, SampleRange samples,
                                             const Films& films)
{
    Scratch scratch = make_scratch(films);
    const std::int64_t index = samples.begin;
    const LightPathCounts& counts = cache_.counts();
    const std::int64_t first = chunk * LightPathCache::chunk_bundles;
    const std::int64_t last = std::min(first + LightPathCache::chunk_bundles, counts.bundles);
    cache_.begin_chunk(chunk);
    for (std::int64_t bundle = first; bundle < last; ++bundle) {
        // Whatever may merge has one time and one wavelength: those of the first light path.
        Sampler sampler = cache_.sampler(index, counts.merged ? 0 : bundle * counts.bundle);
        sampler.start(SampleUse::film);
        const SampleMoment moment = draw_moment(sampler, world_, camera_);
        cache_.add_bundle(chunk, moment);
        const TimedCamera camera(camera_, moment.time);
        for (int i = 0; i < counts.bundle; ++i) {
            SampleContext sample{.world = world_,
                                 .camera = camera.get(),
                                 .sampler = cache_.sampler(index, bundle * counts.bundle + i),
                                 .time = moment.time,
                                 .wavelength = moment.wavelength,
                                 .rays = scratch.stats.rays,
                                 .clock = nullptr};
            scratch.sink.begin_light_path(index);
            trace_light_path(sample, scratch);
            scratch.sink.end_sample();
            if (counts.kept()) {
                cache_.add_path(chunk, scratch.light_path.all());
            }
        }
    }
    cache_.end_chunk(chunk);
    return scratch.stats;
}

bool BidirectionalIntegrator::is_background(const PathVertex& x0) const
{
    return options_.transport.background == Background::none && x0.kind == VertexKind::infinite &&
           x0.light == world_.lights().environment();
}

void BidirectionalIntegrator::trace_light_path(SampleContext& sample, Scratch& scratch) const
{
    sample.enter(Phase::walk);
    trace_light_subpath(sample,
                        {.max_vertices = strategies_.light_vertices(),
                         .rr_start = options_.transport.rr_start,
                         .rr_survival = options_.transport.rr_survival},
                        strategies_.next_event_sampling(), scratch.light_path);
    ++scratch.stats.paths.light;
    sample.enter(Phase::weigh);
    scratch.weigher->begin_light_path(scratch.light_path.all());
    sample.enter(Phase::connect);
    join_light_path(sample, scratch);
}

void BidirectionalIntegrator::join_camera_path(SampleContext& sample, Scratch& scratch) const
{
    for (int t = 2; t <= scratch.camera_path.size(); ++t) {
        const auto camera = scratch.camera_path.first(t);
        if (strategies_.uses(0, t) && !(t == 2 && is_background(camera.back()))) {
            if (const auto found = hit_light(sample, camera, *scratch.weigher)) {
                scratch.sink.add(sample, {.s = 0, .t = t}, *found, strategies_.count(0, t));
                sample.enter(Phase::connect);
            }
        }
        const PathVertex& end = camera.back();
        if (t <= options_.transport.max_depth && strategies_.uses(1, t) && scatters(end.kind) &&
            end.connectible) {
            join_to_lights(sample, camera, scratch);
        }
    }
}

void BidirectionalIntegrator::join_to_lights(SampleContext& sample,
                                             std::span<const PathVertex> camera,
                                             Scratch& scratch) const
{
    const auto t = static_cast<int>(camera.size());
    const auto count = static_cast<std::uint32_t>(strategies_.next_event_sampling().samples);
    const Vec2 first = first_light_sample(sample, t);
    for (std::uint32_t i = 0; i < count; ++i) {
        const Vec2 u = i == 0 ? first : shifted_point(first, i, count);
        if (const auto found = connect_to_light(sample, camera, u, *scratch.weigher)) {
            scratch.sink.add(sample, {.s = 1, .t = t}, *found, strategies_.count(1, t));
            sample.enter(Phase::connect);
        }
    }
}

void BidirectionalIntegrator::join_light_path(SampleContext& sample, Scratch& scratch) const
{
    const Subpath& path = scratch.light_path;
    const int longest_s = std::min(path.size(), options_.transport.max_depth);
    for (int s = 2; s <= longest_s; ++s) {
        if (!strategies_.uses(s, 1)) {
            continue;
        }
        if (const auto splat = connect_to_lens(sample, path.first(s), *scratch.weigher)) {
            scratch.sink.splat(sample, {.s = s, .t = 1}, *splat, strategies_.count(s, 1),
                               static_cast<std::uint32_t>(2 * s));
            sample.enter(Phase::connect);
        }
    }
    for (const LensCrossing& crossing : path.crossings()) {
        const int s = crossing.light_vertices + 1;
        if (s > options_.transport.max_depth + 1 || !strategies_.uses(s, 0) ||
            (s == 2 && is_background(path.first(1).back()))) {
            continue;
        }
        if (const auto splat = hit_lens(sample, path, crossing, *scratch.weigher)) {
            scratch.sink.splat(sample, {.s = s, .t = 0}, *splat, strategies_.count(s, 0),
                               static_cast<std::uint32_t>(2 * s + 1));
            sample.enter(Phase::connect);
        }
    }
}

void BidirectionalIntegrator::join_paths(const SampleContext& sample,
                                         std::span<const PathVertex> light, Scratch& scratch) const
{
    const Subpath& camera = scratch.camera_path;
    for (int t = 2; t <= camera.size(); ++t) {
        const int longest_s =
            std::min(static_cast<int>(light.size()), options_.transport.max_depth + 1 - t);
        for (int s = 2; s <= longest_s; ++s) {
            if (!strategies_.uses(s, t)) {
                continue;
            }
            const auto found = connect_interior(sample, light.first(static_cast<std::size_t>(s)),
                                                camera.first(t), *scratch.weigher);
            if (found) {
                scratch.sink.add(sample, {.s = s, .t = t}, *found, strategies_.count(s, t));
                sample.enter(Phase::connect);
            }
        }
    }
}

void BidirectionalIntegrator::merge_paths(const SampleContext& sample, Scratch& scratch) const
{
    for (int t = 2; t <= scratch.camera_path.size(); ++t) {
        const auto camera = scratch.camera_path.first(t);
        if (!can_merge(camera.back())) {
            continue;
        }
        grid_.for_each_near(camera.back().end.p, [&](std::span<const PathVertex> light) {
            const auto s = static_cast<int>(light.size());
            if (!strategies_.merges(s, t)) {
                return;
            }
            if (const auto found = merge(sample, light, camera, merging_, *scratch.weigher)) {
                scratch.sink.add(sample, {.s = s, .t = t}, *found, merging_.light_paths);
                sample.enter(Phase::connect);
            }
        });
    }
}

}  // namespace bdpt
