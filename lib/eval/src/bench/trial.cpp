#include "bench/bench_parts.h"

#include <bdpt/eval/bench.h>
#include <bdpt/eval/metric.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace bdpt::eval {
namespace {

constexpr double min_seconds = 1e-6;  // resolution of the clock

struct TimedRender {
    RenderResult result;
    double cpu_seconds = 0.0;
    double wall_seconds = 0.0;
};

/// Renders the samples [begin, end); returns none if stopped.
std::optional<TimedRender> render_range(const TrialSetup& setup, SampleRange samples,
                                        std::function<void(const Progress&)> on_progress = {})
{
    RenderOptions options = setup.options;
    options.sampling.samples = samples;
    options.sampling.planned_samples = 0;  // each checkpoint could be the last
    RenderControl control;
    control.stop = setup.control.stop;
    control.on_progress = std::move(on_progress);
    const auto wall = std::chrono::steady_clock::now();
    const double cpu = cpu_seconds();
    RenderResult result = render(setup.scene.scene, setup.scene.camera, options, control);
    const double used = cpu_seconds() - cpu;
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - wall;
    if (result.samples.end() < samples.end) {
        return std::nullopt;
    }
    return TimedRender{
        .result = std::move(result), .cpu_seconds = used, .wall_seconds = passed.count()};
}

/// Resolves the choice of an integrator that chooses, whose time counts once.
TrialSetup with_choice(TrialSetup setup, Checkpoint& point)
{
    const auto wall = std::chrono::steady_clock::now();
    const double cpu = cpu_seconds();
    // Without rates: checkpoints are at any numbers of samples.
    setup.options = choose_integrator(setup.scene.scene, setup.scene.camera, setup.options).options;
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - wall;
    point.cpu_seconds += cpu_seconds() - cpu;
    point.wall_seconds += passed.count();
    return setup;
}

/// Records the errors of `image`.
void judge(const Image& image, const Reference& reference, const MetricScale& scale,
           Checkpoint& point)
{
    const auto error = [&](Metric metric) {
        return mean(error_terms(metric, image, reference.image, scale));
    };
    point.relmse = error(Metric::relmse);
    point.relmse_scales = error(Metric::relmse_scales);
    point.mape = error(Metric::mape);
}

}  // namespace

TrialSetup make_setup(const BenchScene& scene, const RenderOptions& options,
                      IntegratorKind integrator, std::uint64_t seed, const BenchControl& control)
{
    TrialSetup setup{.scene = scene, .options = options, .control = control};
    setup.options.integrator = integrator;
    setup.options.sampling.seed = seed;
    setup.options.film.width = scene.width;
    setup.options.film.height = scene.height;
    setup.options.bidirectional.strategy_depth = 0;
    return setup;
}

std::optional<std::int64_t> samples_in(const TrialSetup& setup, double seconds)
{
    Checkpoint start;
    const TrialSetup chosen = with_choice(setup, start);
    const double left = seconds - start.cpu_seconds;
    std::int64_t samples = 2;
    auto timed = render_range(chosen, {.begin = 0, .end = samples});
    while (timed && timed->cpu_seconds < left / 6.0 && samples < max_samples) {
        samples *= 2;
        timed = render_range(chosen, {.begin = 0, .end = samples});
    }
    if (!timed) {
        return std::nullopt;
    }
    const double fitting =
        static_cast<double>(samples) * left / std::max(timed->cpu_seconds, min_seconds);
    const double most = static_cast<double>(max_samples);
    return 2 * static_cast<std::int64_t>(std::clamp(fitting, 2.0, most) / 2.0);
}

std::optional<Film> render_all(const TrialSetup& setup, std::int64_t samples,
                               const BenchProgressMeter& meter)
{
    auto timed = render_range(setup, {.begin = 0, .end = samples}, [&](const Progress& progress) {
        meter.tell(static_cast<double>(progress.samples_done) / static_cast<double>(samples));
    });
    return timed ? std::optional(std::move(timed->result.film)) : std::nullopt;
}

std::optional<Checkpoint> measure_once(const TrialSetup& setup, std::int64_t samples,
                                       const Reference& reference)
{
    const auto timed = render_range(setup, {.begin = 0, .end = samples});
    if (!timed) {
        return std::nullopt;
    }
    Checkpoint point{.samples = samples,
                     .cpu_seconds = std::max(timed->cpu_seconds, min_seconds),
                     .wall_seconds = timed->wall_seconds};
    judge(timed->result.image(), reference, bench_scale(reference.image), point);
    return point;
}

std::vector<std::int64_t> checkpoint_samples(const BenchGoals& goals)
{
    const std::int64_t last = std::max(goals.equal_time, goals.equal_samples);
    std::vector<std::int64_t> result{goals.equal_time, goals.equal_samples};
    for (std::int64_t samples = 1; samples < last; samples *= 2) {
        result.push_back(samples);
    }
    std::sort(result.begin(), result.end());
    result.erase(std::unique(result.begin(), result.end()), result.end());
    return result;
}

std::optional<Trial> make_trial(const TrialSetup& setup, const BenchGoals& goals,
                                const Reference& reference, const BenchProgressMeter& meter)
{
    const MetricScale scale = bench_scale(reference.image);
    const std::vector<std::int64_t> ends = checkpoint_samples(goals);
    const double last = static_cast<double>(ends.back());
    Trial trial;
    trial.run.integrator = setup.options.integrator;
    trial.run.seed = setup.options.sampling.seed;
    std::optional<Film> film;
    reset_peak_memory();
    Checkpoint point;
    const TrialSetup chosen = with_choice(setup, point);
    for (const std::int64_t end : ends) {
        auto timed =
            render_range(chosen, {.begin = point.samples, .end = end}, [&](const Progress& part) {
                meter.tell(static_cast<double>(point.samples + part.samples_done) / last);
            });
        if (!timed) {
            return std::nullopt;
        }
        if (film) {
            film->merge(timed->result.film);
        } else {
            film = std::move(timed->result.film);
        }
        trial.run.stats += timed->result.stats;
        point.samples = end;
        point.cpu_seconds += std::max(timed->cpu_seconds, min_seconds);
        point.wall_seconds += timed->wall_seconds;
        Image image = film->develop();
        judge(image, reference, scale, point);
        trial.run.checkpoints.push_back(point);
        if (end == goals.equal_time) {
            trial.image = std::move(image);
        }
    }
    const FilmDefects defects = film->defects();
    trial.run.invalid = defects.invalid;
    trial.run.saturated = defects.saturated;
    trial.run.peak_memory = peak_memory();
    return trial;
}

}  // namespace bdpt::eval
