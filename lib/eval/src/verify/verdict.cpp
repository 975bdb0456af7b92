#include "verify/verdict.h"

#include <bdpt/eval/statistics.h>

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
                           .tiles = {},
                           .channels = {}};
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
        .tiles = {},
        .channels = {}};
    for (std::size_t tile = 0; tile < evidence.whole(); ++tile) {
        result.tiles.push_back(compare_integrator(evidence, tile, edges, integrator));
    }
    return result;
}

MergeFinding describe_merges(const Evidence& evidence, int edges)
{
    return {.edges = edges,
            .brought = evidence.merges(edges).sums.brought /
                       evidence.samples_in(evidence.whole(), IntegratorKind::vcm, edges),
            .whole = compare_merges(evidence, edges),
            .channels = {}};
}

/// Returns all findings by one measure.
VerifyReport describe(const Evidence& evidence, int max_depth)
{
    VerifyReport report;
    report.radiance = evidence.images()[0].mean();
    for (int edges = 1; edges <= max_depth; ++edges) {
        report.lengths.push_back(describe_length(evidence, edges));
        for (int s = 0; s <= edges + 1; ++s) {
            report.strategies.push_back(describe_strategy(evidence, {.s = s, .t = edges + 1 - s}));
        }
        for (std::size_t i = 0; i < evidence.others(); ++i) {
            report.integrators.push_back(describe_integrator(evidence, edges, i));
        }
        if (evidence.knows_merges()) {
            report.merges.push_back(describe_merges(evidence, edges));
        }
    }
    return report;
}

/// Calls `visit` for the comparison of the whole image of each finding, with its index.
template <typename Visit>
void for_each_whole(VerifyReport& report, const Visit& visit)
{
    const auto visit_each = [&](auto findings) {
        for (std::size_t i = 0; i < (report.*findings).size(); ++i) {
            const auto same = [ findings, i ](VerifyReport & of) -> auto&
            {
                return (of.*findings)[i];
            };
            visit((report.*findings)[i].whole, same);
        }
    };
    visit_each(&VerifyReport::strategies);
    visit_each(&VerifyReport::integrators);
    visit_each(&VerifyReport::merges);
}

std::vector<MeanComparison*> tests_of_images(VerifyReport& report,
                                             std::vector<VerifyReport>& channels)
{
    std::vector<MeanComparison*> tests;
    const auto add = [&tests](MeanComparison& test, const auto&) { tests.push_back(&test); };
    for_each_whole(report, add);
    for (VerifyReport& channel : channels) {
        for_each_whole(channel, add);
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
    const auto of_image = [&](const auto& finding) {
        return fail(finding.whole) ||
               std::any_of(finding.channels.begin(), finding.channels.end(), fail);
    };
    const auto any = [&](const auto& finding) {
        return of_image(finding) || std::any_of(finding.tiles.begin(), finding.tiles.end(), fail);
    };
    return report.weights.wrong > 0 ||
           std::any_of(report.images.begin(), report.images.end(),
                       [](const ImageFinding& image) {
                           return image.defects.invalid > 0 || image.defects.saturated > 0 ||
                                  loses_light(image);
                       }) ||
           std::any_of(report.strategies.begin(), report.strategies.end(), any) ||
           std::any_of(report.integrators.begin(), report.integrators.end(), any) ||
           std::any_of(report.merges.begin(), report.merges.end(), of_image);
}

/// Returns the weighted paths that only one strategy, and no integrator from the camera, can
/// sample.
double unchecked(const Evidence& evidence, int max_depth)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < StrategyRow(max_depth).size(); ++i) {
        sum += evidence.strategy(evidence.whole(), i).sums.unchecked;
    }
    return sum;
}

}  // namespace

bool is_sharp(const VerifyReport& report, const VerifyOptions& options)
{
    return report.detectable <= options.detectable_bias &&
           (report.merges.empty() || report.detectable_of_merging <= max_error_of_merging);
}

VerifyReport judge(const Evidence& evidence, const VerifyOptions& options)
{
    VerifyReport report = describe(evidence, options.max_depth);
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
    std::vector<VerifyReport> channels;
    for (const Evidence& channel : evidence.channels()) {
        channels.push_back(describe(channel, options.max_depth));
    }
    const std::vector<MeanComparison*> images = tests_of_images(report, channels);
    correct(images);
    correct(tests_of_tiles(report));
    if (report.radiance > 0.0) {
        const double samples = evidence.bdpt_samples_in(evidence.whole());
        const double distance = detectable_z(critical_z(0.5 * options.false_alarm, images.size()),
                                             static_cast<double>(evidence.batches() - 1));
        report.unchecked = unchecked(evidence, options.max_depth) / samples / report.radiance;
        double worst = find_detectable(evidence, report, distance);
        for (std::size_t i = 0; i < channels.size(); ++i) {
            // Errors of a channel are fractions of the image, or of the channel if that is
            // brighter.
            channels[i].radiance = std::max(channels[i].radiance, report.radiance);
            worst = std::max(worst, find_detectable(evidence.channels()[i], channels[i], distance));
        }
        if (samples >= trusted_samples) {
            report.detectable = worst;
            report.detectable_of_merging = find_detectable_of_merging(evidence, report, distance);
        }
    }
    for (VerifyReport& channel : channels) {
        for_each_whole(channel, [&](const MeanComparison& test, const auto& select) {
            select(report).channels.push_back(test);
        });
    }
    report.verdict = has_failed(report)          ? Verdict::fail
                     : is_sharp(report, options) ? Verdict::pass
                                                 : Verdict::inconclusive;
    return report;
}

}  // namespace bdpt::eval
