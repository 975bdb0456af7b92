#include "verify/verdict.h"

#include <algorithm>
#include <limits>

namespace bdpt::eval {
namespace {

/// Returns the error of the image, as a fraction, that the noise can hide if strategy v of paths of
/// `edges` edges is wrong by a factor 1 + c. Such an error moves the expected value of each
/// strategy u by c times its part that v found; the difference of v itself keeps c times the part
/// that the others found.
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
        moved /= evidence.bdpt_samples_in(evidence.whole());
        // An error of 0 means there was no test: u found nothing that differs.
        if (moved > 0.0 && test.error > 0.0) {
            least = std::min(least, distance * test.error / moved);
        }
    }
    return least * brought / report.radiance;
}

/// Returns the same bound for the light that no other strategy of bdpt finds, by the tests of pt,
/// nee and mis for paths of this length.
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

}  // namespace

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
        // All of the light that only this strategy finds is at stake, unless path tracers check it.
        const double alone =
            (sums.solitary - sums.unchecked) / evidence.bdpt_samples_in(evidence.whole());
        const double by_strategies = std::max(
            detectable_by_strategies(evidence, report, finding, distance), alone / report.radiance);
        finding.whole.detectable =
            std::min(by_strategies, detectable_by_integrators(report, edges));
        worst = std::max(worst, finding.whole.detectable);
    }
    return worst;
}

double find_detectable_of_merging(const Evidence& evidence, const VerifyReport& report,
                                  double distance)
{
    double least = std::numeric_limits<double>::infinity();
    for (const MergeFinding& finding : report.merges) {
        const MergeSumsOfLength& sums = evidence.merges(finding.edges).sums;
        // An excess of c moves the found value by c, and the expected one by c times the merged
        // part of it.
        const double moved =
            (sums.expected - sums.by_merges) /
            evidence.samples_in(evidence.whole(), IntegratorKind::vcm, finding.edges);
        if (moved > 0.0 && finding.whole.error > 0.0) {
            least = std::min(least, distance * finding.whole.error / moved);
        }
    }
    return least;
}

}  // namespace bdpt::eval
