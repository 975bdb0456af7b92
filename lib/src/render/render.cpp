#include <bdpt/error.h>
#include <bdpt/integrators.h>
#include <bdpt/part/sample_rates.h>
#include <bdpt/render.h>

#include "camera/moving_camera.h"
#include "integrator/integrator.h"
#include "profile/time_recorder.h"
#include "render/aov_pass.h"
#include "render/check_options.h"
#include "render/noise_watch.h"
#include "render/open_camera.h"
#include "render/pass.h"
#include "render/strategy_images.h"
#include "scene/world.h"
#include "threads/threads.h"

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

/// How many samples passes have, so that one takes about `pass_seconds`. With rates they are groups
/// of rounds.
class PassSize {
public:
    PassSize(const Integrator& integrator, const RenderOptions& options)
        : most_(std::min(most_samples_in_pass, integrator.most_samples_in_pass()))
    {
        if (options.sampling.rates) {
            most_ = most_samples_in_pass;
            samples_ = SampleRates::group;
        }
    }
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

PixelCounts pixel_counts(const RenderOptions& options)
{
    return options.sampling.rates ? PixelCounts::own : PixelCounts::equal;
}

/// A part of the render without any samples.
RenderPart empty_part(Identity identity, const RenderOptions& options, const CameraDesc& camera,
                      const AovPass& aov_pass)
{
    const FilmLayout layout = film_layout(options);
    return {.identity = std::move(identity),
            .samples = {},
            .film = Film(layout),
            .aovs = AovFilm(layout.region, options.film.aovs, pixel_counts(options)),
            .ids = IdFilm(layout.region, options.film.aovs, aov_pass.names()),
            .strategies = StrategyFilm(layout.region, strategies_with_images(options, camera)),
            .stats = {}};
}

/// That `part` is one of this render: files may say so of films that are others.
void check_part(const RenderPart& part, const Identity& identity, const RenderOptions& options,
                const CameraDesc& camera, const AovPass& aov_pass)
{
    if (const auto what = difference(identity, part.identity)) {
        throw Error(ErrorCode::invalid_input, "the part is of another render: " + *what);
    }
    if (part.film.layout() != film_layout(options) || part.aovs.aovs() != options.film.aovs ||
        part.aovs.counts() != pixel_counts(options) || part.ids.names() != aov_pass.names() ||
        part.strategies.strategies() != strategies_with_images(options, camera)) {
        throw Error(ErrorCode::invalid_input, "the part's films are not those of its render");
    }
}

}  // namespace

RenderResult result_of(PartResult done)
{
    RenderPart& part = done.part;
    return {.film = std::move(part.film),
            .aovs = std::move(part.aovs),
            .ids = std::move(part.ids),
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
    Identity identity = bdpt::identity(scene, camera_desc, options);
    const PixelRect region = options.film.crop.value_or(whole_image(options));
    const MovingCamera camera = open_camera(scene.world(), camera_desc, options);
    const auto integrator = make_integrator(scene.world(), camera, options);
    const AovPass aov_pass(scene.world(), camera, options);
    if (!so_far.samples.empty()) {
        check_part(so_far, identity, options, camera_desc, aov_pass);
    }

    Threads threads(options.system.threads);

    PartResult result{.part = so_far.samples.empty()
                                  ? empty_part(std::move(identity), options, camera_desc, aov_pass)
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
    PassSize pass_size(*integrator, options);
    NoiseWatch noise(control, options.sampling.samples);
    threads.execute([&] { noise.look(part); });
    while (done < total && !noise.reached()) {
        const SampleRange pass =
            next_pass(part.samples, wanted, noise.at_most(pass_size.samples(), part));
        const double before = seconds_since(start);
        threads.execute([&] {
            render_pass({.integrator = *integrator,
                         .aov_pass = aov_pass,
                         .on_path = control.on_path,
                         .times = times ? &*times : nullptr},
                        options, pass, part);
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
