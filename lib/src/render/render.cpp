#include <bdpt/render.h>

#include "camera/camera.h"
#include "integrator/integrator.h"
#include "path/strategy_set.h"
#include "render/aov_pass.h"
#include "render/check_options.h"
#include "render/noise_watch.h"
#include "render/pass.h"
#include "render/view.h"
#include "scene/world.h"
#include "threads/threads.h"

#include <bdpt/error.h>
#include <bdpt/noise.h>
#include <bdpt/part/render_result.h>
#include <bdpt/part/sample_rates.h>
#include <bdpt/render_options.h>
#include <bdpt/renderer.h>
#include <bdpt/scene_desc.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace bdpt {
namespace {

/// Target duration of a pass, the unit of progress and of stopping.
constexpr double pass_seconds = 0.5;
constexpr std::int64_t max_samples_in_pass = 64;

double seconds_since(std::chrono::steady_clock::time_point start)
{
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Adapts the number of samples per pass to `pass_seconds`. With rates they are groups of rounds.
class PassSize {
public:
    PassSize(const Integrator& integrator, const RenderOptions& options)
        : most_(std::min(max_samples_in_pass, integrator.max_samples_in_pass()))
    {
        if (options.sampling.rates) {
            most_ = max_samples_in_pass;
            samples_ = SampleRates::group;
        }
    }
    [[nodiscard]] std::int64_t samples() const { return samples_; }
    /// Updates the size with the duration of the last pass.
    void learn(std::int64_t samples, double seconds)
    {
        seconds_a_sample_ = seconds / static_cast<double>(samples);
        if (seconds_a_sample_ * static_cast<double>(2 * samples_) < pass_seconds) {
            samples_ = std::min(2 * samples_, most_);
        }
    }
    /// Returns the expected duration of the next pass [s].
    [[nodiscard]] double seconds() const
    {
        return seconds_a_sample_ * static_cast<double>(samples_);
    }

private:
    std::int64_t most_;
    std::int64_t samples_ = 1;
    double seconds_a_sample_ = 0.0;
};

/// Returns the next missing samples of `wanted`, at most `size`.
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

/// Tests whether the camera supports a strategy: only a finite lens can be hit, and s = t = 1 needs
/// a perspective camera.
bool camera_allows(const CameraDesc& camera, Strategy strategy)
{
    const bool perspective = camera.projection == Projection::perspective;
    if (strategy.t == 0) {
        return perspective && camera.lens_radius > 0.0f;
    }
    return perspective || strategy != Strategy{.s = 1, .t = 1};
}

/// Returns the strategies of a render that get images, shortest paths first, then by s: those that
/// are used and that the camera supports, up to `strategy_depth`. `options` and `camera` have been
/// checked.
std::vector<Strategy> strategies_with_images(const RenderOptions& options, const CameraDesc& camera)
{
    std::vector<Strategy> result;
    if (options.bidirectional.strategy_depth == 0) {
        return result;
    }
    const StrategySet used(options);
    const int longest = std::min(options.bidirectional.strategy_depth, options.transport.max_depth);
    for (int edges = 1; edges <= longest; ++edges) {
        for (int s = 0; s <= edges + 1; ++s) {
            const Strategy strategy{.s = s, .t = edges + 1 - s};
            if (used.uses(s, strategy.t) && camera_allows(camera, strategy)) {
                result.push_back(strategy);
            }
        }
    }
    return result;
}

/// Throws `Error` (usage) if the images would take more than `strategy_memory`.
void check_strategy_memory(const RenderOptions& options, const CameraDesc& camera)
{
    const std::uint64_t bytes = strategy_image_bytes(options, camera);
    if (bytes > options.bidirectional.strategy_memory) {
        throw Error(ErrorCode::usage, "images of strategies up to " +
                                          std::to_string(options.bidirectional.strategy_depth) +
                                          " edges (strategy_depth) take " + megabytes(bytes) +
                                          ", more than the limit (strategy_memory) of " +
                                          megabytes(options.bidirectional.strategy_memory));
    }
}

/// Returns a part of the render without any samples.
RenderResult empty_part(Identity identity, const RenderOptions& options, const CameraDesc& camera,
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

/// Checks that `part` is one of this render: files may claim so for films of others.
void check_part(const RenderResult& part, const Identity& identity, const RenderOptions& options,
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

std::uint64_t strategy_image_bytes(const RenderOptions& options, const CameraDesc& camera)
{
    check_options(options);
    return StrategyFilm::bytes_per_pixel * film_layout(options).region.area() *
           strategies_with_images(options, camera).size();
}

RenderResult render(const Scene& scene, const CameraDesc& camera, const RenderOptions& options,
                    const RenderControl& control)
{
    return continue_render(scene, camera, options, {}, control);
}

/// State shared by the calls of a render. Not movable: its members refer to each other.
class Renderer::Impl {
public:
    Impl(const Scene& scene, const CameraDesc& camera_desc, const RenderOptions& asked)
        : options_(chosen_options(scene, camera_desc, asked)), camera_desc_(camera_desc)
    {
        check_strategy_memory(options_, camera_desc_);
        identity_ = bdpt::identity(scene, camera_desc_, options_);
        camera_.emplace(open_camera(scene.world(), camera_desc_, options_));
        learned_ = learned_light(scene.world(), camera_desc_, options_);
        integrator_ = make_integrator(scene.world(), *camera_, options_, learned_.get());
        aov_pass_.emplace(scene.world(), *camera_, options_);
        pass_size_.emplace(*integrator_, options_);
    }

    [[nodiscard]] const RenderOptions& options() const { return options_; }
    [[nodiscard]] const RenderResult& result() const { return result_; }
    /// Begins without samples. Films take memory, so that they are created once, by this or
    /// go_on().
    void begin() { result_ = empty_part(identity_, options_, camera_desc_, *aov_pass_); }
    /// Moves the part out. Nothing may be rendered afterwards before begin() or go_on().
    [[nodiscard]] RenderResult take() { return std::move(result_); }

    /// Continues with `part` in place of the current one.
    void go_on(RenderResult part)
    {
        check_part(part, identity_, options_, camera_desc_, *aov_pass_);
        result_ = std::move(part);
    }
    void add(const RenderResult& part)
    {
        check_part(part, identity_, options_, camera_desc_, *aov_pass_);
        merge(result_, part);
    }

    /// Returns the smallest range of samples from the first one that contains `count` missing ones.
    [[nodiscard]] SampleRange next(std::int64_t count) const
    {
        SampleRange range{.begin = options_.sampling.samples.begin,
                          .end = options_.sampling.samples.begin};
        for (std::int64_t missing = count; missing > 0;
             missing = count - result_.samples.missing(SampleSet(range)).count()) {
            range.end += missing;
        }
        return range;
    }

    /// Renders the missing samples of `wanted`. `start` is the start of the call, for its time
    /// limit.
    void run(SampleRange wanted_range, const RenderControl& control,
             std::chrono::steady_clock::time_point start, double cpu_start);

private:
    RenderOptions options_;
    CameraDesc camera_desc_;
    Identity identity_;
    std::optional<MovingCamera> camera_;
    std::shared_ptr<const LearnedLight> learned_;
    std::unique_ptr<Integrator> integrator_;
    std::optional<AovPass> aov_pass_;
    RenderResult result_;
    std::optional<PassSize> pass_size_;
    bool is_abandoned_ = false;  ///< `result_` has no films
};

void Renderer::Impl::run(SampleRange wanted_range, const RenderControl& control,
                         std::chrono::steady_clock::time_point start, double cpu_start)
{
    if (std::exchange(is_abandoned_, false)) {
        begin();  // now, as a caller that abandons a render may not continue it
    }
    Threads threads(options_.system.threads);
    const SampleSet wanted(wanted_range);
    const std::int64_t total = result_.samples.missing(wanted).count();
    const double cpu_before = result_.cpu_seconds;
    const double seconds_before = result_.seconds;
    std::int64_t done = 0;
    NoiseWatch noise(control, wanted_range);
    threads.execute([&] { noise.look(result_); });
    while (done < total && !noise.reached()) {
        const SampleRange pass =
            next_pass(result_.samples, wanted, noise.at_most(pass_size_->samples(), result_));
        const double before = seconds_since(start);
        threads.execute([&] {
            render_pass({.integrator = *integrator_,
                         .aov_pass = *aov_pass_,
                         .on_path = control.on_path,
                         .abandon = control.abandon},
                        options_, pass, result_);
            if (!control.abandon.stop_requested()) {
                noise.look(result_);
            }
        });
        if (control.abandon.stop_requested()) {
            result_ = {};
            is_abandoned_ = true;
            return;
        }
        done += pass.end - pass.begin;
        const double seconds = seconds_since(start);
        result_.seconds = seconds_before + seconds;
        result_.cpu_seconds = cpu_before + cpu_seconds() - cpu_start;
        if (control.on_progress) {
            control.on_progress({.samples_done = done,
                                 .samples_total = total,
                                 .seconds = seconds,
                                 .noise = noise.noise(),
                                 .noise_samples = noise.samples()});
        }
        if (control.on_part) {
            control.on_part(result_);
        }
        pass_size_->learn(pass.end - pass.begin, seconds - before);
        // Includes the time of `on_part`.
        if (control.stop.stop_requested() ||
            seconds_since(start) + pass_size_->seconds() > control.time_limit) {
            break;
        }
    }
}

RenderResult continue_render(const Scene& scene, const CameraDesc& camera,
                             const RenderOptions& options, RenderResult so_far,
                             const RenderControl& control)
{
    const auto start = std::chrono::steady_clock::now();
    const double cpu_start = cpu_seconds();
    Renderer::Impl render(scene, camera, options);
    if (so_far.samples.empty()) {
        render.begin();
    } else {
        render.go_on(std::move(so_far));
    }
    render.run(options.sampling.samples, control, start, cpu_start);
    return render.take();
}

Renderer::Renderer(const Scene& scene, const CameraDesc& camera, const RenderOptions& options)
    : impl_(std::make_unique<Impl>(scene, camera, options))
{
    impl_->begin();
}

Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

void Renderer::render(std::int64_t samples, const RenderControl& control)
{
    if (samples < 1) {
        throw Error(ErrorCode::usage,
                    "number of samples to render is " + std::to_string(samples) + ", not above 0");
    }
    const std::int64_t unit = options().sampling.rates ? SampleRates::group : 1;
    const std::int64_t whole = (samples - 1) / unit * unit + unit;
    impl_->run(impl_->next(whole), control, std::chrono::steady_clock::now(), cpu_seconds());
}

void Renderer::finish(const RenderControl& control)
{
    impl_->run(options().sampling.samples, control, std::chrono::steady_clock::now(),
               cpu_seconds());
}

Renderer& Renderer::operator+=(const RenderResult& part)
{
    impl_->add(part);
    return *this;
}

const RenderOptions& Renderer::options() const
{
    return impl_->options();
}

const RenderResult& Renderer::result() const
{
    return impl_->result();
}

std::int64_t Renderer::samples() const
{
    return result().samples.count();
}

double Renderer::noise() const
{
    return estimate_noise(result().film, result().aovs);
}

Image Renderer::image() const
{
    return result().image();
}

double Renderer::seconds() const
{
    return result().seconds;
}

RenderResult Renderer::take()
{
    RenderResult taken = impl_->take();
    impl_->begin();
    return taken;
}

void merge(RenderResult& result, const RenderResult& other)
{
    if (const auto what = difference(result.identity, other.identity)) {
        throw Error(ErrorCode::invalid_input, "parts of different renders: " + *what);
    }
    if (const SampleSet both = result.samples.overlap(other.samples); !both.empty()) {
        throw Error(ErrorCode::invalid_input, "parts that both have the samples " + both.text());
    }
    result.film.merge(other.film);
    result.aovs.merge(other.aovs);
    result.ids.merge(other.ids);
    result.strategies.merge(other.strategies);
    result.samples.add(other.samples);
    result.stats += other.stats;
    result.seconds += other.seconds;
    result.cpu_seconds += other.cpu_seconds;
}

}  // namespace bdpt
