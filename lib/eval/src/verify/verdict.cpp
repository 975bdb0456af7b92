#include "verify/verdict.h"

#include "verify/compare_evidence.h"
#include "verify/sharpness.h"

#include <bdpt/eval/statistics/holm.h>

#include <algorithm>

namespace bdpt::eval {
namespace {

LengthFinding describe_length(const Evidence& evidence, int edges)
{
    const LengthEvidence& length = evidence.length(evidence.whole(), edges);
    const double all = length.sums.all.radiance;
    const auto part = [all](double radiance) {
        return all > 0.0 ? std::min(radiance / all, 1.0) : 1.0;
    };
    return {.edges = edges,
            .radiance = length.radiance.mean(),
            .error = length.radiance.standard_error(),
            .seen_from_camera = part(length.sums.from_camera.radiance),
            .seen_from_light = part(length.sums.from_light.radiance)};
}

StrategyFinding describe_strategy(const Evidence& evidence, Strategy strategy)
{
    const std::size_t index = evidence.row().index(strategy);
    const std::size_t whole = evidence.whole();
    const StrategySums& sums = evidence.strategy(whole, index).sums;
    const double all = evidence.length(whole, strategy.s + strategy.t - 1).sums.all.radiance;
    const double samples = evidence.bdpt_samples_in(whole);
    StrategyFinding result{.strategy = strategy,
                           .blind = all > 0.0 ? std::clamp(1.0 - sums.reach / all, 0.0, 1.0) : 0.0,
                           .weighted = sums.weighted / samples,
                           .unweighted = sums.unweighted / samples,
                           .solitary = sums.solitary / samples,
                           .whole = compare_strategy(evidence, whole, index),
                           .tiles = {}};
    for (std::size_t tile = 0; tile < whole; ++tile) {
        result.tiles.push_back(compare_strategy(evidence, tile, index));
    }
    return result;
}

IntegratorFinding describe_integrator(const Evidence& evidence, int edges, std::size_t integrator)
{
    IntegratorFinding result{
        .integrator = other_integrators[integrator],
        .edges = edges,
        .whole = compare_integrator(evidence, evidence.whole(), edges, integrator),
        .tiles = {}};
    for (std::size_t tile = 0; tile < evidence.whole(); ++tile) {
        result.tiles.push_back(compare_integrator(evidence, tile, edges, integrator));
    }
    return result;
}

std::vector<MeanComparison*> tests_of_images(VerifyReport& report)
{
    std::vector<MeanComparison*> tests;
    for (StrategyFinding& finding : report.strategies) {
        tests.push_back(&finding.whole);
    }
    for (IntegratorFinding& finding : report.integrators) {
        tests.push_back(&finding.whole);
    }
    return tests;
}

std::vector<MeanComparison*> tests_of_tiles(VerifyReport& report)
{
    std::vector<MeanComparison*> tests;
    const auto add = [&tests](std::vector<MeanComparison>& tiles) {
        for (MeanComparison& tile : tiles) {
            tests.push_back(&tile);
        }
    };
    for (StrategyFinding& finding : report.strategies) {
        add(finding.tiles);
    }
    for (IntegratorFinding& finding : report.integrators) {
        add(finding.tiles);
    }
    return tests;
}

void correct(const std::vector<MeanComparison*>& tests)
{
    std::vector<double> p;
    for (const MeanComparison* test : tests) {
        p.push_back(test->p);
    }
    const std::vector<double> adjusted = holm_adjusted(p);
    for (std::size_t i = 0; i < tests.size(); ++i) {
        tests[i]->p_adjusted = adjusted[i];
    }
}

bool has_failed(const VerifyReport& report)
{
    const auto fail = [&report](const MeanComparison& test) { return fails(test, report); };
    const auto any = [&](const auto& finding) {
        return fail(finding.whole) || std::any_of(finding.tiles.begin(), finding.tiles.end(), fail);
    };
    return report.weights.wrong > 0 ||
           std::any_of(report.images.begin(), report.images.end(),
                       [](const ImageFinding& image) {
                           return image.defects.invalid > 0 || image.defects.saturated > 0 ||
                                  loses_light(image);
                       }) ||
           std::any_of(report.strategies.begin(), report.strategies.end(), any) ||
           std::any_of(report.integrators.begin(), report.integrators.end(), any);
}

}  // namespace

VerifyReport judge(const Evidence& evidence, const VerifyOptions& options)
{
    VerifyReport report;
    report.batches = evidence.batches();
    report.false_alarm = options.false_alarm;
    report.tiles = evidence.grid().tiles();
    report.weights = evidence.weights();
    for (std::size_t i = 0; i <= evidence.others(); ++i) {
        const Moments& image = evidence.images()[i];
        report.images.push_back(
            {.integrator = i == 0 ? IntegratorKind::bdpt : other_integrators[i - 1],
             .radiance = image.mean(),
             .error = image.standard_error(),
             .defects = evidence.checks()[i].defects,
             .lost = evidence.checks()[i].lost});
    }
    report.radiance = report.images[0].radiance;
    double unchecked = 0.0;
    for (int edges = 1; edges <= options.max_depth; ++edges) {
        report.lengths.push_back(describe_length(evidence, edges));
        for (int s = 0; s <= edges + 1; ++s) {
            const Strategy strategy{.s = s, .t = edges + 1 - s};
            report.strategies.push_back(describe_strategy(evidence, strategy));
            unchecked +=
                evidence.strategy(evidence.whole(), evidence.row().index(strategy)).sums.unchecked;
        }
        for (std::size_t i = 0; i < evidence.others(); ++i) {
            report.integrators.push_back(describe_integrator(evidence, edges, i));
        }
    }
    const std::vector<MeanComparison*> images = tests_of_images(report);
    correct(images);
    correct(tests_of_tiles(report));
    if (report.radiance > 0.0) {
        const double samples = evidence.bdpt_samples_in(evidence.whole());
        report.unchecked = unchecked / samples / report.radiance;
        const double worst =
            find_detectable(evidence, report,
                            detectable_z(critical_z(0.5 * options.false_alarm, images.size()),
                                         static_cast<double>(evidence.batches() - 1)));
        if (samples >= trusted_samples) {
            report.detectable = worst;
        }
    }
    report.verdict = has_failed(report)                             ? Verdict::fail
                     : report.detectable <= options.detectable_bias ? Verdict::pass
                                                                    : Verdict::inconclusive;
    return report;
}

}  // namespace bdpt::eval
