#include <bdpt/error.h>
#include <bdpt/integrators.h>
#include <bdpt/render.h>

#include "camera/moving_camera.h"
#include "film/pixel_filter.h"
#include "geometry/flush_denormals.h"
#include "integrator/integrator.h"
#include "profile/time_recorder.h"
#include "render/aov_pass.h"
#include "render/check_options.h"
#include "render/noise_watch.h"
#include "render/open_camera.h"
#include "render/strategy_images.h"
#include "render/threads.h"
#include "scene/world.h"

#include <tbb/blocked_range2d.h>
#include <tbb/combinable.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <optional>
#include <utility>

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
                 RenderPart& result)
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
    result.samples.add(samples);
}

/// How many samples passes have, so that one takes about `pass_seconds`.
class PassSize {
public:
    explicit PassSize(const Integrator& integrator)
        : most_(std::min(most_samples_in_pass, integrator.most_samples_in_pass()))
    {}
    [[nodiscard]] std::int64_t samples() const { return samples_; }
    /// Takes note of the last pass.
    void learn(std::int64_t samples, double seconds)
    {
        seconds_a_sample_ = seconds / static_cast<double>(samples);
        if (seconds_a_sample_ * static_cast<double>(2 * samples_) < pass_seconds) {
            samples_ = std::min(2 * samples_, most_);
        }
    }
    /// What the next pass will probably take [s].
    [[nodiscard]] double seconds() const
    {
        return seconds_a_sample_ * static_cast<double>(samples_);
    }

private:
    std::int64_t most_;
    std::int64_t samples_ = 1;
    double seconds_a_sample_ = 0.0;
};

/// What is missing of `wanted`, as passes of at most `size` samples.
SampleRange next_pass(const SampleSet& done, const SampleSet& wanted, std::int64_t size)
{
    const SampleSet missing = done.missing(wanted);
    if (missing.empty()) {
        return {.begin = 0, .end = 0};
    }
    const SampleRange first = missing.ranges().front();
    return {.begin = first.begin, .end = std::min(first.begin + size, first.end)};
}

double cpu_seconds()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
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

/// A part of the render without any samples.
RenderPart empty_part(Identity identity, const RenderOptions& options, const CameraDesc& camera)
{
    const FilmLayout layout = film_layout(options);
    return {.identity = std::move(identity),
            .samples = {},
            .film = Film(layout),
            .aovs = AovFilm(layout.region, options.film.aovs),
            .strategies = StrategyFilm(layout.region, strategies_with_images(options, camera)),
            .stats = {}};
}

void check_part(const RenderPart& part, const Identity& identity, const RenderOptions& options)
{
    if (const auto what = difference(identity, part.identity)) {
        throw Error(ErrorCode::invalid_input, "the part is of another render: " + *what);
    }
    if (part.film.layout() != film_layout(options)) {
        throw Error(ErrorCode::usage, "the part's film is not that of its render");
    }
}

}  // namespace

RenderResult result_of(PartResult done)
{
    RenderPart& part = done.part;
    return {.film = std::move(part.film),
            .aovs = std::move(part.aovs),
            .strategies = std::move(part.strategies),
            .stats = part.stats,
            .options = std::move(done.options),
            .samples = part.samples.empty() ? SampleRange{} : part.samples.ranges().front(),
            .seconds = done.seconds,
            .profile = std::move(done.profile)};
}

RenderResult render(const Scene& scene, const CameraDesc& camera, const RenderOptions& options,
                    const RenderControl& control)
{
    return result_of(render_part(scene, camera, options, {}, control));
}

PartResult render_part(const Scene& scene, const CameraDesc& camera_desc,
                       const RenderOptions& asked, RenderPart so_far, const RenderControl& control)
{
    const auto start = std::chrono::steady_clock::now();
    const double cpu_start = cpu_seconds();
    const RenderOptions options = chosen_options(scene, camera_desc, asked);
    check_strategy_memory(options, camera_desc);
    if (control.on_path && options.integrator == IntegratorKind::vcm) {
        throw Error(ErrorCode::usage,
                    "vcm cannot tell of single paths (on_path): a path that it "
                    "merges is not that of a strategy (s, t)");
    }
    Identity identity = bdpt::identity(scene, camera_desc, options);
    if (!so_far.samples.empty()) {
        check_part(so_far, identity, options);
    }
    const PixelRect region = options.film.crop.value_or(whole_image(options));
    const MovingCamera camera = open_camera(scene.world(), camera_desc, options);
    const auto integrator = make_integrator(scene.world(), camera, options);
    const AovPass aov_pass(scene.world(), camera, options);

    Threads threads(options.system.threads);

    PartResult result{.part = so_far.samples.empty()
                                  ? empty_part(std::move(identity), options, camera_desc)
                                  : std::move(so_far),
                      .options = options};
    RenderPart& part = result.part;
    std::optional<TimeRecorder> times;
    if (control.profiling == Profiling::on) {
        times.emplace(region);
    }
    const SampleSet wanted(options.sampling.samples);
    const std::int64_t total = part.samples.missing(wanted).count();
    const double cpu_before = part.cpu_seconds;
    std::int64_t done = 0;
    PassSize pass_size(*integrator);
    NoiseWatch noise(control, options.sampling.samples);
    threads.execute([&] { noise.look(part); });
    while (done < total && !noise.reached()) {
        const SampleRange pass =
            next_pass(part.samples, wanted, noise.at_most(pass_size.samples(), part));
        const double before = seconds_since(start);
        threads.execute([&] {
            render_pass({*integrator, aov_pass, control, times ? &*times : nullptr}, options, pass,
                        part);
            noise.look(part);
        });
        done += pass.end - pass.begin;
        result.seconds = seconds_since(start);
        part.cpu_seconds = cpu_before + cpu_seconds() - cpu_start;
        if (control.on_progress) {
            control.on_progress({.samples_done = done,
                                 .samples_total = total,
                                 .seconds = result.seconds,
                                 .noise = noise.noise(),
                                 .noise_samples = noise.samples()});
        }
        if (control.on_part) {
            control.on_part(part);
        }
        pass_size.learn(pass.end - pass.begin, result.seconds - before);
        // What `on_part` took counts, too.
        if (control.stop.stop_requested() ||
            seconds_since(start) + pass_size.seconds() > control.time_limit) {
            break;
        }
    }
    if (times) {
        result.profile = times->profile(done);
    }
    return result;
}

}  // namespace bdpt
