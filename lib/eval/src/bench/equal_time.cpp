#include <bdpt/eval/equal_time.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "bench/bench_parts.h"

namespace bdpt::eval {
namespace {

TrialSetup make_trial_setup(const BenchScene& scene, const RenderOptions& options,
                            std::uint64_t seed, const BenchControl& control)
{
    return make_setup(scene, options, options.integrator, seed, control);
}

Score compute_score(const std::vector<Checkpoint>& ends, double noise,
                    std::optional<double> seconds)
{
    std::vector<double> errors;
    std::vector<double> times;
    const auto samples = static_cast<double>(ends.front().samples);
    for (const Checkpoint& end : ends) {
        const double error = std::max(end.relmse - noise, 1e-12);
        errors.push_back(seconds ? error * end.cpu_seconds / *seconds : error);
        times.push_back(end.cpu_seconds / samples);
    }
    return {.error = spread(std::move(errors)),
            .sample_seconds = spread(std::move(times)).median,
            .samples = ends.front().samples};
}

}  // namespace

Reference render_reference(const BenchScene& scene, const RenderOptions& options,
                           std::int64_t samples)
{
    const BenchControl control;
    const BenchProgressMeter meter(0.0, control);
    const TrialSetup setup =
        make_setup(scene, options, IntegratorKind::bdpt, reference_seed, control);
    // Never stopped, so it has a value.
    const Film film = render_all(setup, samples, meter).value();
    HalvedImage halved{
        .image = film.develop(), .first = film.develop_half(0), .second = film.develop_half(1)};
    const double noise = estimate_noise(halved, halved.image);
    return {.image = std::move(halved.image),
            .noise = noise,
            .origin = "bdpt with " + std::to_string(samples) + " samples"};
}

std::vector<Score> compare_at_equal_time(const BenchScene& scene, const Reference& reference,
                                         std::span<const Variant> variants,
                                         const EqualTimeOptions& options)
{
    const BenchControl control;
    std::vector<std::int64_t> samples;
    for (const Variant& variant : variants) {
        samples.push_back(
            options.samples
                ? *options.samples
                : samples_in(make_trial_setup(scene, variant.options, 0, control), options.seconds)
                      .value());
    }
    std::vector<std::vector<Checkpoint>> ends(variants.size());
    for (int round = 0; round < options.rounds; ++round) {
        for (std::size_t v = 0; v < variants.size(); ++v) {
            const TrialSetup setup = make_trial_setup(scene, variants[v].options,
                                                      static_cast<std::uint64_t>(round), control);
            ends[v].push_back(measure_once(setup, samples[v], reference).value());
        }
    }
    const std::optional<double> equal_seconds =
        options.samples ? std::nullopt : std::optional(options.seconds);
    std::vector<Score> scores;
    for (const std::vector<Checkpoint>& of_variant : ends) {
        scores.push_back(compute_score(of_variant, reference.noise, equal_seconds));
    }
    return scores;
}

}  // namespace bdpt::eval
