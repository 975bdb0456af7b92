#include "contest.h"

#include <CLI/CLI.hpp>

#include <algorithm>

#include "measure.h"

namespace bdpt {
namespace {

struct Trial {
    double error = 0.0;
    double seconds = 0.0;  // of CPU time
};

Trial run(const Subject& subject, const Reference* reference, const Variant& variant,
          std::int64_t samples, int round)
{
    RenderOptions options = variant.options;
    options.samples = {.begin = 0, .end = samples};
    options.seed = static_cast<std::uint64_t>(round);
    const double begin = cpu_seconds();
    const RenderResult result = render(subject.scene, subject.camera, options);
    const double seconds = cpu_seconds() - begin;
    return {.error = reference != nullptr ? error_of(result.film, *reference) : 0.0,
            .seconds = seconds};
}

/// How many samples take about `seconds`: from renders that grow until one takes a good part of it.
std::int64_t samples_in(const Subject& subject, const Variant& variant, double seconds)
{
    std::int64_t samples = 2;
    double taken = run(subject, nullptr, variant, samples, 0).seconds;
    while (taken < seconds / 6.0) {
        samples *= 2;
        taken = run(subject, nullptr, variant, samples, 0).seconds;
    }
    const double fitting = static_cast<double>(samples) * seconds / taken;
    return std::max<std::int64_t>(2 * static_cast<std::int64_t>(fitting / 2.0), 2);
}

Score score_of(const std::vector<Trial>& trials, std::int64_t samples)
{
    std::vector<double> errors;
    std::vector<double> seconds;
    for (const Trial& trial : trials) {
        errors.push_back(trial.error);
        seconds.push_back(trial.seconds / static_cast<double>(samples));
    }
    return {.error = median(errors),
            .least_error = *std::min_element(errors.begin(), errors.end()),
            .greatest_error = *std::max_element(errors.begin(), errors.end()),
            .sample_seconds = median(seconds),
            .samples = samples};
}

}  // namespace

void add_options(CLI::App& app, Contest& contest)
{
    app.add_option("--time", contest.seconds, "CPU seconds a render")->capture_default_str();
    app.add_option("--rounds", contest.rounds, "Renders of each variant")->capture_default_str();
}

std::vector<Score> compete(const Subject& subject, const Reference& reference,
                           std::span<const Variant> variants, const Contest& contest)
{
    std::vector<std::int64_t> samples;
    for (const Variant& variant : variants) {
        samples.push_back(samples_in(subject, variant, contest.seconds));
    }
    const auto trials = in_turn(variants.size(), contest.rounds, [&](std::size_t v, int round) {
        Trial trial = run(subject, &reference, variants[v], samples[v], round);
        trial.error *= trial.seconds / contest.seconds;
        return trial;
    });
    std::vector<Score> scores;
    for (std::size_t v = 0; v < variants.size(); ++v) {
        scores.push_back(score_of(trials[v], samples[v]));
    }
    return scores;
}

std::vector<Score> compete_at_equal_samples(const Subject& subject, const Reference& reference,
                                            std::span<const Variant> variants, std::int64_t samples,
                                            int rounds)
{
    const auto trials = in_turn(variants.size(), rounds, [&](std::size_t v, int round) {
        return run(subject, &reference, variants[v], samples, round);
    });
    std::vector<Score> scores;
    for (const auto& of_variant : trials) {
        scores.push_back(score_of(of_variant, samples));
    }
    return scores;
}

}  // namespace bdpt
