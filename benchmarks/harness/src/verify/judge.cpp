#include "verify/judge.h"

#include "verify/compare_means.h"

#include <bdpt/harness/statistics/holm.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace bdpt::harness {
namespace {

double squared_error(const Moments& moments)
{
    return moments.variance() / static_cast<double>(moments.count());
}

/// Samples of bdpt in a cell.
double samples_in(const Evidence& evidence, std::size_t cell)
{
    return bdpt_samples * evidence.pixels(cell) * static_cast<double>(evidence.batches());
}

/// Samples of an estimate: how many and which there were, and what `expected_samples` of them are
/// expected to be.
struct SampleMoments {
    double samples;
    const SecondMoment& seen;
    double expected_samples;
    const SecondMoment& expected;
};

/// What the spread lacks of the variance of a mean: that of rare samples, one of which moves the
/// mean too much, as far as fewer of them were seen than expected.
double unseen_variance(const SampleMoments& of, double sample_variance)
{
    const double size = rare_fraction * std::sqrt(sample_variance) * of.samples;
    const double unseen =
        of.expected.above(size) / of.expected_samples - of.seen.above(size) / of.samples;
    return std::max(unseen, 0.0) / of.samples;
}

MeanComparison compare_strategy(const Evidence& evidence, std::size_t cell, std::size_t index)
{
    const StrategyEvidence& found = evidence.strategy(cell, index);
    const double samples = samples_in(evidence, cell);
    const double variance = squared_error(found.difference);
    return compare_means(
        {.found = found.sums.tested / samples,
         .expected = found.sums.expected / samples,
         .sample_variance = variance,
         .rare_variance = unseen_variance({.samples = samples,
                                           .seen = found.sums.seen,
                                           .expected_samples = samples,
                                           .expected = found.sums.second_moment},
                                          variance),
         .freedom = static_cast<double>(found.difference.count() - 1)});
}

const SecondMoment& second_moment(const LengthSums& sums, IntegratorKind integrator)
{
    switch (integrator) {
        case IntegratorKind::pt:
            return sums.pt;
        case IntegratorKind::nee:
            return sums.nee;
        case IntegratorKind::mis:
            return sums.mis;
        default:
            return sums.lt;
    }
}

MeanComparison compare_integrator(const Evidence& evidence, std::size_t cell, int edges,
                                  std::size_t integrator)
{
    const LengthEvidence& length = evidence.length(cell, edges);
    const IntegratorKind kind = other_integrators[integrator];
    const bool from_light = kind == IntegratorKind::lt;
    const ReachSums& reach = from_light ? length.sums.from_light : length.sums.from_camera;
    const Moments& expected = from_light ? length.from_light : length.from_camera;
    const Moments& found = length.others[integrator];
    const double variance = squared_error(found) + squared_error(expected);
    const double samples = samples_in(evidence, cell);
    const double rare = unseen_variance({.samples = samples / bdpt_samples * samples_of(kind, edges),
                                         .seen = length.seen[integrator],
                                         .expected_samples = samples,
                                         .expected = second_moment(length.sums, kind)},
                                        variance) +
                        unseen_variance({.samples = samples,
                                         .seen = reach.seen,
                                         .expected_samples = samples,
                                         .expected = reach.second_moment},
                                        variance);
    return compare_means({.found = found.mean(),
                          .expected = reach.radiance / samples,
                          .sample_variance = variance,
                          .rare_variance = rare,
                          .freedom = welch_freedom(found, expected)});
}

LengthFinding describe_length(const Evidence& evidence, int edges)
{
    const LengthEvidence& length = evidence.length(evidence.whole(), edges);
    const double all = length.sums.radiance;
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
    const double all = evidence.length(whole, strategy.s + strategy.t - 1).sums.radiance;
    const double samples = samples_in(evidence, whole);
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

std::vector<MeanComparison*> tests_of_pictures(VerifyReport& report)
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

/// What can hide behind the noise if strategy v of paths of `edges` edges is wrong by a factor 1 +
/// c, as a fraction of the picture. That moves what is expected of each strategy u by c times what
/// of it v has found, but for v itself, of whose difference c times what the others found remains.
double detectable_by_strategies(const Evidence& evidence, const VerifyReport& report,
                                const StrategyFinding& v, double distance)
{
    const double brought = v.weighted - v.solitary;
    if (!(brought > 0.0)) {
        return 0.0;
    }
    const int edges = v.strategy.s + v.strategy.t - 1;
    const auto finder = static_cast<std::size_t>(v.strategy.s);
    const std::size_t first = evidence.row().begin(edges);
    double least = std::numeric_limits<double>::infinity();  // c
    for (std::size_t u = 0; u < static_cast<std::size_t>(edges + 2); ++u) {
        const MeanComparison& test = report.strategies[first + u].whole;
        double moved = evidence.expected_from(edges, u, finder);
        if (u == finder) {
            moved = 0.0;
            for (std::size_t other = 0; other < static_cast<std::size_t>(edges + 2); ++other) {
                moved += other == finder ? 0.0 : evidence.expected_from(edges, u, other);
            }
        }
        moved /= samples_in(evidence, evidence.whole());
        // Without an error there was no test: u has found nothing that differs.
        if (moved > 0.0 && test.error > 0.0) {
            least = std::min(least, distance * test.error / moved);
        }
    }
    return least * brought / report.radiance;
}

/// The same for the light that no other strategy of bdpt makes, and as what pt, nee and mis say of
/// paths of this length.
double detectable_by_integrators(const VerifyReport& report, int edges)
{
    double least = std::numeric_limits<double>::infinity();
    for (const IntegratorFinding& other : report.integrators) {
        if (other.edges == edges && other.integrator != IntegratorKind::lt) {
            least = std::min(least, other.whole.detectable);
        }
    }
    return least;
}

/// Fills in what could be detected, and returns the worst of all strategies.
double find_detectable(const Evidence& evidence, VerifyReport& report, double distance)
{
    for (IntegratorFinding& finding : report.integrators) {
        finding.whole.detectable = distance * finding.whole.error / report.radiance;
    }
    double worst = 0.0;
    for (StrategyFinding& finding : report.strategies) {
        const int edges = finding.strategy.s + finding.strategy.t - 1;
        const std::size_t index = evidence.row().index(finding.strategy);
        const StrategySums& sums = evidence.strategy(evidence.whole(), index).sums;
        // What only this strategy can make is all at stake, unless path tracers check it.
        const double alone =
            (sums.solitary - sums.unchecked) / samples_in(evidence, evidence.whole());
        const double by_strategies = std::max(
            detectable_by_strategies(evidence, report, finding, distance), alone / report.radiance);
        finding.whole.detectable =
            std::min(by_strategies, detectable_by_integrators(report, edges));
        worst = std::max(worst, finding.whole.detectable);
    }
    return worst;
}

bool has_failed(const VerifyReport& report)
{
    const auto fail = [&report](const MeanComparison& test) { return fails(test, report); };
    const auto any = [&](const auto& finding) {
        return fail(finding.whole) || std::any_of(finding.tiles.begin(), finding.tiles.end(), fail);
    };
    return report.weights.wrong > 0 ||
           std::any_of(report.pictures.begin(), report.pictures.end(),
                       [](const PictureFinding& picture) {
                           return picture.defects.invalid > 0 || picture.defects.saturated > 0 ||
                                  loses_light(picture);
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
    for (std::size_t i = 0; i < report.pictures.size(); ++i) {
        const Moments& picture = evidence.pictures()[i];
        report.pictures[i] = {
            .integrator = i == 0 ? IntegratorKind::bdpt : other_integrators[i - 1],
            .radiance = picture.mean(),
            .error = picture.standard_error(),
            .defects = evidence.checks()[i].defects,
            .lost = evidence.checks()[i].lost};
    }
    report.radiance = report.pictures[0].radiance;
    double unchecked = 0.0;
    for (int edges = 1; edges <= options.max_depth; ++edges) {
        report.lengths.push_back(describe_length(evidence, edges));
        for (int s = 0; s <= edges + 1; ++s) {
            const Strategy strategy{.s = s, .t = edges + 1 - s};
            report.strategies.push_back(describe_strategy(evidence, strategy));
            unchecked +=
                evidence.strategy(evidence.whole(), evidence.row().index(strategy)).sums.unchecked;
        }
        for (std::size_t i = 0; i < other_integrators.size(); ++i) {
            report.integrators.push_back(describe_integrator(evidence, edges, i));
        }
    }
    const std::vector<MeanComparison*> pictures = tests_of_pictures(report);
    correct(pictures);
    correct(tests_of_tiles(report));
    if (report.radiance > 0.0) {
        report.unchecked = unchecked / samples_in(evidence, evidence.whole()) / report.radiance;
        report.detectable =
            find_detectable(evidence, report,
                            detectable_z(critical_z(0.5 * options.false_alarm, pictures.size()),
                                         static_cast<double>(evidence.batches() - 1)));
    }
    report.verdict = has_failed(report)                             ? Verdict::fail
                     : report.detectable <= options.detectable_bias ? Verdict::pass
                                                                    : Verdict::inconclusive;
    return report;
}

}  // namespace bdpt::harness
