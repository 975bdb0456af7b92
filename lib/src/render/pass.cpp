#include "render/pass.h"

#include "geometry/flush_denormals.h"
#include "integrator/sample_schedule.h"
#include "render/view.h"

#include <bdpt/options/integrators.h>

#include <tbb/blocked_range.h>
#include <tbb/combinable.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace bdpt {
namespace {

void count_samples(const SampleSchedule& schedule, const Tile& tile, SampleRange samples,
                   AovFilm& film)
{
    for (int y = tile.y_begin; y < tile.y_end; ++y) {
        for (int x = tile.x_begin; x < tile.x_end; ++x) {
            if (film.region().contains(x, y)) {
                film.count_samples(x, y, schedule.count(x, y, samples));
            }
        }
    }
}

/// Renders the samples of the tile into all films.
RenderStats render_tile(const Work& work, const RenderOptions& options, const Tile& tile,
                        SampleRange samples, const Films& films, RenderResult& result)
{
    RenderStats stats = work.integrator.render_tile(tile, samples, films);
    if (work.on_tile) {
        work.on_tile(tile, stats);
    }
    if (result.aovs.needs_camera_rays() || result.ids.needs_hits()) {
        stats += work.aov_pass.render_tile(tile, samples, result.aovs, result.ids);
    }
    if (result.aovs.needs_counts()) {
        count_samples(SampleSchedule(options), tile, samples, result.aovs);
    }
    return stats;
}

/// Renders the chunks of a batch, which its tiles share.
void render_chunks(const Work& work, SampleRange samples, std::int64_t batch, RenderResult& result,
                   tbb::combinable<RenderStats>& stats_of_threads)
{
    const ChunkRange chunks = work.integrator.begin_batch(samples, batch);
    tbb::parallel_for(chunks.begin, chunks.end, [&](std::int64_t chunk) {
        if (work.abandon.stop_requested()) {
            return;
        }
        const FlushDenormals flush;
        stats_of_threads.local() += work.integrator.render_chunk(
            chunk, samples,
            {.film = &result.film, .strategies = result.strategies, .on_path = work.on_path});
    });
    if (!work.abandon.stop_requested()) {
        work.integrator.end_chunks();
    }
}

/// Returns the tiles of the region, group after group.
std::vector<Tile> tiles_of(const PixelRect& region, int side, const Integrator& integrator)
{
    std::vector<Tile> tiles;
    for (int y = region.y0; y < region.y1; y += side) {
        for (int x = region.x0; x < region.x1; x += side) {
            tiles.push_back({.x_begin = x,
                             .x_end = std::min(x + side, region.x1),
                             .y_begin = y,
                             .y_end = std::min(y + side, region.y1)});
        }
    }
    std::ranges::stable_sort(tiles, {}, [&](const Tile& tile) { return integrator.group(tile); });
    return tiles;
}

void render_at_once(const Work& work, const RenderOptions& options, SampleRange samples,
                    RenderResult& result)
{
    // Each pixel of the whole image has its light path, and any of them can reach a crop.
    const PixelRect region =
        info(options.integrator).traces_light_paths ? whole_image(options) : result.film.region();
    const std::vector<Tile> tiles =
        tiles_of(region, work.integrator.tile_side(options.system.tile_size), work.integrator);
    tbb::combinable<RenderStats> stats_of_threads;
    std::size_t begin = 0;
    for (std::int64_t batch = 0; batch < work.integrator.batches(); ++batch) {
        render_chunks(work, samples, batch, result, stats_of_threads);
        std::size_t end = begin;
        while (end < tiles.size() && work.integrator.batch(tiles[end]) == batch) {
            ++end;
        }
        tbb::parallel_for(
            tbb::blocked_range<std::size_t>(begin, end),
            [&](const tbb::blocked_range<std::size_t>& range) {
                if (work.abandon.stop_requested()) {
                    return;
                }
                const FlushDenormals flush;
                const Films films{
                    .film = &result.film, .strategies = result.strategies, .on_path = work.on_path};
                for (std::size_t i = range.begin(); i < range.end(); ++i) {
                    stats_of_threads.local() +=
                        render_tile(work, options, tiles[i], samples, films, result);
                }
            },
            tbb::simple_partitioner{});
        if (work.abandon.stop_requested()) {
            return;
        }
        begin = end;
    }
    stats_of_threads.combine_each([&](const RenderStats& stats) { result.stats += stats; });
}

}  // namespace

void render_pass(const Work& work, const RenderOptions& options, SampleRange samples,
                 RenderResult& result)
{
    const std::int64_t most = work.integrator.max_samples_in_pass();
    for (SampleRange some = samples; some.begin < samples.end; some.begin = some.end) {
        some.end = samples.end - some.begin > most ? some.begin + most : samples.end;
        render_at_once(work, options, some, result);
        if (work.abandon.stop_requested()) {
            return;
        }
    }
    result.film.count_samples(samples.begin, samples.end);
    result.strategies.count_samples(samples.end - samples.begin);
    result.samples.add(samples);
}

FilmLayout film_layout(const RenderOptions& options)
{
    return {.width = options.film.width,
            .height = options.film.height,
            .region = options.film.crop.value_or(whole_image(options)),
            .splats = info(options.integrator).traces_light_paths ? SplatImage::present
                                                                  : SplatImage::absent,
            .clamp = options.film.clamp};
}

}  // namespace bdpt
