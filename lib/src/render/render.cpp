#include <bdpt/error.h>
#include <bdpt/integrators.h>
#include <bdpt/render.h>

#include "camera/moving_camera.h"
#include "film/pixel_filter.h"
#include "integrator/integrator.h"
#include "profile/time_recorder.h"
#include "render/aov_pass.h"
#include "render/check_options.h"
#include "render/flush_denormals.h"
#include "render/open_camera.h"
#include "render/strategy_images.h"
#include "render/threads.h"
#include "scene/world.h"

#include <tbb/blocked_range2d.h>
#include <tbb/combinable.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <optional>

namespace bdpt {
namespace {

/// A pass is one unit of progress and of stopping: it grows until it takes about this long.
constexpr double pass_seconds = 0.5;
constexpr std::int64_t most_samples_in_pass = 64;

double seconds_since(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// All that works on a tile.
struct Work {
    Integrator& integrator;
    const AovPass& aov_pass;
    const RenderControl& control;
    TimeRecorder* times;  // if times are recorded
};

void render_pass(const Work& work, const RenderOptions& options, SampleRange samples,
                 RenderResult& result)
{
    // Each pixel of the whole image has its light path, and any of them can reach a crop.
    const PixelRect area =
        info(options.integrator).traces_light_paths ? whole_image(options) : result.film.region();
    const int columns = (area.width() + options.system.tile_size - 1) / options.system.tile_size;
    const int rows = (area.height() + options.system.tile_size - 1) / options.system.tile_size;
    tbb::combinable<RenderStats> stats_of_threads;
    tbb::parallel_for(std::int64_t{0}, work.integrator.begin_pass(samples), [&](std::int64_t part) {
        const FlushDenormals flush;
        stats_of_threads.local() += work.integrator.do_part(part, samples,
                                                            {.film = &result.film,
                                                             .strategies = result.strategies,
                                                             .on_path = work.control.on_path});
    });
    work.integrator.end_parts();
    tbb::parallel_for(
        tbb::blocked_range2d<int>(0, rows, 1, 0, columns, 1),
        [&](const tbb::blocked_range2d<int>& range) {
            const FlushDenormals flush;
            auto times = work.times != nullptr ? std::optional(work.times->sheet()) : std::nullopt;
            const Films films{.film = &result.film,
                              .strategies = result.strategies,
                              .on_path = work.control.on_path,
                              .times = times ? &*times : nullptr};
            for (int row = range.rows().begin(); row < range.rows().end(); ++row) {
                for (int column = range.cols().begin(); column < range.cols().end(); ++column) {
                    const int x = area.x0 + column * options.system.tile_size;
                    const int y = area.y0 + row * options.system.tile_size;
                    const Tile tile{.x_begin = x,
                                    .x_end = std::min(x + options.system.tile_size, area.x1),
                                    .y_begin = y,
                                    .y_end = std::min(y + options.system.tile_size, area.y1)};
                    RenderStats& stats = stats_of_threads.local();
                    stats += work.integrator.render_tile(tile, samples, films);
                    if (result.aovs.needs_hits()) {
                        stats += work.aov_pass.render_tile(tile, samples, result.aovs);
                    }
                }
            }
        },
        tbb::simple_partitioner{});
    stats_of_threads.combine_each([&](const RenderStats& stats) { result.stats += stats; });
    result.film.count_samples(samples.begin, samples.end);
    result.strategies.count_samples(samples.end - samples.begin);
}

}  // namespace

RenderResult render(const Scene& scene, const CameraDesc& camera_desc, const RenderOptions& asked,
                    const RenderControl& control)
{
    const auto start = std::chrono::steady_clock::now();
    const RenderOptions options = chosen_options(scene, camera_desc, asked);
    check_strategy_memory(options, camera_desc);
    if (control.on_path && options.integrator == IntegratorKind::vcm) {
        throw Error(ErrorCode::usage,
                    "vcm cannot tell of single paths (on_path): a path that it "
                    "merges is not that of a strategy (s, t)");
    }
    const PixelRect region = options.film.crop.value_or(whole_image(options));
    const MovingCamera camera = open_camera(scene.world(), camera_desc, options);
    const auto integrator = make_integrator(scene.world(), camera, options);
    const AovPass aov_pass(scene.world(), camera, options);

    Threads threads(options.system.threads);

    const FilmLayout layout{.width = options.film.width,
                            .height = options.film.height,
                            .region = region,
                            .splats = info(options.integrator).traces_light_paths
                                          ? SplatImage::present
                                          : SplatImage::absent,
                            .clamp = options.film.clamp};
    RenderResult result{
        .film = Film(layout),
        .aovs = AovFilm(region, options.film.aovs),
        .strategies = StrategyFilm(region, strategies_with_images(options, camera_desc)),
        .stats = {},
        .options = options,
        .samples = {.begin = options.sampling.samples.begin, .end = options.sampling.samples.begin},
        .seconds = 0.0};
    std::optional<TimeRecorder> times;
    if (control.profiling == Profiling::on) {
        times.emplace(region);
    }
    std::int64_t pass_size = 1;
    while (result.samples.end < options.sampling.samples.end) {
        const std::int64_t begin = result.samples.end;
        const std::int64_t end = std::min(begin + pass_size, options.sampling.samples.end);
        const double before = seconds_since(start);
        threads.execute([&] {
            render_pass({*integrator, aov_pass, control, times ? &*times : nullptr}, options,
                        {.begin = begin, .end = end}, result);
        });
        result.samples.end = end;
        result.seconds = seconds_since(start);
        if (control.on_progress) {
            control.on_progress(
                {.samples_done = end - options.sampling.samples.begin,
                 .samples_total = options.sampling.samples.end - options.sampling.samples.begin,
                 .seconds = result.seconds});
        }
        const double seconds_a_sample =
            (result.seconds - before) / static_cast<double>(end - begin);
        if (seconds_a_sample * static_cast<double>(2 * pass_size) < pass_seconds) {
            pass_size =
                std::min({2 * pass_size, most_samples_in_pass, integrator->most_samples_in_pass()});
        }
        const double next = seconds_a_sample * static_cast<double>(pass_size);
        if (control.stop.stop_requested() || result.seconds + next > control.time_limit) {
            break;
        }
    }
    if (times) {
        result.profile = times->profile(result.samples.end - result.samples.begin);
    }
    return result;
}

}  // namespace bdpt
