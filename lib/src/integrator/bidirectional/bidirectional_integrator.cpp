#include "integrator/bidirectional/bidirectional_integrator.h"

#include "camera/camera.h"
#include "integrator/sample_schedule.h"
#include "path/merge.h"

#include <algorithm>
#include <bit>

namespace bdpt {

struct BidirectionalIntegrator::Scratch {
    Scratch(const BidirectionalIntegrator& integrator, const Films& films);

    Subpath light_path;
    Subpath camera_path;
    PathWeigher weigher;
    ContributionSink sink;
    PathJoiner joiner;
    RenderStats stats{};
};

namespace {

/// Returns the random numbers of a sample's own light paths, which differ from those of the sample.
Sampler light_sampler(const RenderOptions& options, int x, int y, std::int64_t index)
{
    constexpr std::uint64_t odd = 0xd1342543de82ef95U;  // gives a seed that is not used elsewhere
    return {options.sampling.sampler, options.sampling.seed + odd, x, y, index};
}

}  // namespace

BidirectionalIntegrator::BidirectionalIntegrator(const World& world, const MovingCamera& camera,
                                                 const RenderOptions& options,
                                                 const LearnedLight* learned)
    : world_(world),
      camera_(camera),
      options_(options),
      schedule_(options_),
      filter_(options.film.filter),
      strategies_(options, learned),
      cache_(LightPathCounts(options), options)
{}

std::int64_t BidirectionalIntegrator::max_samples_in_pass() const
{
    return cache_.counts().kept() ? 1 : Integrator::max_samples_in_pass();
}

int BidirectionalIntegrator::own_light_paths() const
{
    return cache_.counts().shared ? 0 : static_cast<int>(strategies_.light_paths());
}

BidirectionalIntegrator::Scratch::Scratch(const BidirectionalIntegrator& integrator,
                                          const Films& films)
    : light_path(integrator.strategies_.light_vertices()),
      camera_path(integrator.strategies_.camera_vertices()),
      weigher(integrator.world_, integrator.camera_.first(), integrator.strategies_,
              integrator.options_.transport.heuristic, integrator.options_.transport.max_depth + 1,
              integrator.merging_.weight()),
      // One splat for each strategy with t <= 1.
      sink(films, integrator.filter_, &weigher,
           static_cast<std::size_t>(2 * integrator.strategies_.light_vertices() *
                                        std::max(1, integrator.own_light_paths()) +
                                    2)),
      joiner(integrator.options_, integrator.strategies_, weigher, sink)
{
    if (films.on_path) {
        weigher.keep_paths();
    }
}

ChunkRange BidirectionalIntegrator::begin_batch(SampleRange samples, std::int64_t batch)
{
    merging_ = Merging(options_, cache_.counts(), world_.bounding_sphere(), samples.begin);
    if (!cache_.counts().shared) {
        return {};
    }
    if (!cache_.counts().kept()) {
        return {.begin = 0, .end = cache_.chunks() * (samples.end - samples.begin)};
    }
    return cache_.begin_batch(batch);
}

void BidirectionalIntegrator::end_chunks()
{
    if (cache_.counts().merged) {
        grid_.build(cache_, world_.bounding_sphere().center, merging_.radius);
    }
}

int BidirectionalIntegrator::tile_side(int wanted) const
{
    if (cache_.counts().batches == 1) {
        return wanted;
    }
    // Divides the side of a block.
    return static_cast<int>(
        std::bit_floor(static_cast<unsigned>(std::min(wanted, PixelGroups::block_side))));
}

RenderStats BidirectionalIntegrator::render_tile(const Tile& tile, SampleRange samples,
                                                 const Films& films) const
{
    Scratch scratch(*this, films);
    // Of a tile outside of the crop, only these pixels can contribute to it.
    const auto is_outside = [&](const PixelRect& region) {
        return tile.x_end <= region.x0 || tile.x_begin >= region.x1 || tile.y_end <= region.y0 ||
               tile.y_begin >= region.y1;
    };
    const bool only_splats =
        own_light_paths() == 0 && films.film != nullptr && is_outside(films.film->region());
    const int stride = only_splats ? scratch.joiner.light_to_lens_pixels().stride() : 1;
    const auto first = [stride](int begin) { return (begin + stride - 1) / stride * stride; };
    for (int y = first(tile.y_begin); y < tile.y_end; y += stride) {
        for (int x = first(tile.x_begin); x < tile.x_end; x += stride) {
            schedule_.for_each(x, y, samples, [&](const ScheduledSample& scheduled) {
                add_sample(x, y, scheduled, scratch);
            });
        }
    }
    return scratch.stats;
}

void BidirectionalIntegrator::add_sample(int x, int y, const ScheduledSample& scheduled,
                                         Scratch& scratch) const
{
    ContributionSink& sink = scratch.sink;
    const std::int64_t index = scheduled.index;
    sink.begin_sample(x, y, scheduled);
    // Own light paths of pixels outside of a crop can splat into it, and so can lights.
    const bool wanted = sink.holds_pixel();
    if (!wanted && own_light_paths() == 0 &&
        !scratch.joiner.connects_light_to_lens(
            Sampler(options_.sampling.sampler, options_.sampling.seed, x, y, index,
                    log_samples(options_.sampling, x, y)),
            x, y)) {
        sink.end_sample();
        return;
    }
    SampleStart start(options_, filter_, world_, camera_, x, y, index);
    LightPathCache::Choice shared;
    if (cache_.counts().kept()) {
        shared = cache_.choose(x, y, scheduled);
        cache_.prefetch(shared);
        start.moment = cache_.moment(shared.bundle);
    }
    const TimedCamera camera(camera_, start.moment.time);
    SampleContext sample = start.context(world_, camera.get(), scratch.stats.rays);

    trace_camera_subpath(sample, start.raster,
                         {.max_vertices = wanted ? strategies_.camera_vertices() : 1,
                          .rr_start = options_.transport.rr_start,
                          .rr_survival = options_.transport.rr_survival},
                         scratch.camera_path);
    scratch.joiner.join_camera_path(sample, scratch.camera_path);
    if (cache_.counts().rays > 0.0) {
        scratch.joiner.join_chosen(sample, cache_, shared, scratch.camera_path);
    } else {
        for (int i = 0; i < shared.count; ++i) {
            sink.begin_joins(i);
            scratch.joiner.join_paths(sample, cache_.path(shared, i), scratch.camera_path);
        }
    }
    if (cache_.counts().merged) {
        merge_paths(sample, scratch);
    }
    for (int i = 0; i < own_light_paths(); ++i) {
        if (own_light_paths() > 1) {
            sample.sampler =
                light_sampler(options_, x, y, subsample_index(index, own_light_paths(), i));
        }
        sink.begin_joins(i);
        trace_light_path(sample, scratch);
        scratch.joiner.join_paths(sample, scratch.light_path.all(), scratch.camera_path);
    }
    scratch.stats.paths.camera += wanted ? 1U : 0U;
    sink.end_sample();
}

RenderStats BidirectionalIntegrator::render_chunk(std::int64_t part, SampleRange samples,
                                                  const Films& films)
{
    Scratch scratch(*this, films);
    const LightPathCounts& counts = cache_.counts();
    const std::int64_t index = samples.begin + part / cache_.chunks();
    const std::int64_t chunk = part % cache_.chunks();
    const std::int64_t first = chunk * LightPathCache::chunk_bundles;
    const std::int64_t last = std::min(first + LightPathCache::chunk_bundles, counts.bundles);
    const bool keeps = counts.kept();
    if (keeps) {
        cache_.begin_chunk(chunk);
    }
    for (std::int64_t bundle = first; bundle < last; ++bundle) {
        // Vertices that may merge share one time and one wavelength: those of the first light path.
        Sampler sampler = cache_.sampler(index, counts.merged ? 0 : bundle, 0);
        sampler.start(SampleUse::film);
        const TimeAndWavelength moment = draw_time_and_wavelength(sampler, world_, camera_);
        if (keeps) {
            cache_.add_bundle(chunk, moment);
        }
        const TimedCamera camera(camera_, moment.time);
        for (int i = 0; i < counts.bundle; ++i) {
            SampleContext sample{.world = world_,
                                 .camera = camera.get(),
                                 .sampler = cache_.sampler(index, bundle, i),
                                 .time = moment.time,
                                 .wavelength = moment.wavelength,
                                 .rays = scratch.stats.rays};
            scratch.sink.begin_light_path(index);
            trace_light_path(sample, scratch);
            scratch.sink.end_sample();
            if (keeps) {
                cache_.add_path(chunk, scratch.light_path.all());
            }
        }
    }
    if (keeps) {
        cache_.end_chunk(chunk);
    }
    return scratch.stats;
}

void BidirectionalIntegrator::trace_light_path(SampleContext& sample, Scratch& scratch) const
{
    trace_light_subpath(sample,
                        {.max_vertices = strategies_.light_vertices(),
                         .rr_start = options_.transport.rr_start,
                         .rr_survival = options_.transport.rr_survival},
                        strategies_.next_event_sampling(), scratch.light_path);
    ++scratch.stats.paths.light;
    scratch.joiner.join_light_path(sample, scratch.light_path);
}

double BidirectionalIntegrator::chance_of_merges(Vec3 p) const
{
    const int most = options_.bidirectional.max_merges;
    if (most == 0) {
        return 1.0;
    }
    int near = 0;
    grid_.for_each_near(p, [&](std::span<const PathVertex>) { ++near; });
    return near > most ? static_cast<double>(most) / near : 1.0;
}

void BidirectionalIntegrator::merge_paths(const SampleContext& sample, Scratch& scratch) const
{
    scratch.sink.begin_merges();
    const double choice =
        sample.sampler.ordered_1d(SampleUse::light_walk, Sampler::choice_of_connections);
    for (int t = 2; t <= scratch.camera_path.size(); ++t) {
        const auto camera = scratch.camera_path.first(t);
        if (!can_merge(camera.back())) {
            continue;
        }
        const double chance = chance_of_merges(camera.back().end.p);
        double at = chance < 1.0 ? choice : 0.0;
        grid_.for_each_near(camera.back().end.p, [&](std::span<const PathVertex> light) {
            // Systematic sampling: steps of equal length, of which each integer ends a choice.
            at += chance;
            if (at < 1.0) {
                return;
            }
            at -= 1.0;
            const auto s = static_cast<int>(light.size());
            if (!strategies_.merges(s, t)) {
                return;
            }
            if (auto found = merge(light, camera, merging_, scratch.weigher)) {
                found->chance = static_cast<float>(chance);
                found->unweighted *= 1.0f / found->chance;
                scratch.sink.add(sample, {.s = s, .t = t}, *found, merging_.light_paths);
            }
        });
    }
}

}  // namespace bdpt
