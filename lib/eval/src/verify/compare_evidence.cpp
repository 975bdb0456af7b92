#include <bdpt/eval/statistics.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "verify/verdict.h"

namespace bdpt::eval {

MeanComparison compare_means(const Difference& difference)
{
    MeanComparison result;
    result.found = difference.found;
    result.expected = difference.expected;
    const double distance = difference.found - difference.expected;
    if (distance == 0.0) {
        return result;
    }
    const double tolerance = indifference * std::abs(difference.expected);
    result.error =
        std::sqrt(difference.sample_variance + difference.rare_variance + tolerance * tolerance);
    result.z = result.error > 0.0
                   ? distance / result.error
                   : std::copysign(std::numeric_limits<double>::infinity(), distance);
    const double bound = std::min(1.0, 2.0 * std::exp(-0.5 * result.z * result.z));
    result.p = std::max(bound, student_two_sided_p(result.z, difference.freedom));
    return result;
}

double welch_freedom(const Moments& a, const Moments& b)
{
    const double x = a.variance() / static_cast<double>(a.count());
    const double y = b.variance() / static_cast<double>(b.count());
    const double sum = x + y;
    if (!(sum > 0.0)) {
        return static_cast<double>(std::min(a.count(), b.count()) - 1);
    }
    return sum * sum /
           (x * x / static_cast<double>(a.count() - 1) +
            y * y / static_cast<double>(b.count() - 1));
}

double critical_z(double false_alarm, std::size_t tests)
{
    return std::sqrt(
        2.0 * std::log(2.0 * static_cast<double>(std::max<std::size_t>(tests, 1)) / false_alarm));
}

double detectable_z(double critical, double freedom)
{
    constexpr double ninety_percent = 1.2816;  // quantile of a normal distribution
    return critical + ninety_percent * std::sqrt(1.0 + critical * critical / (2.0 * freedom));
}

namespace {

double squared_error(const Moments& moments)
{
    return moments.variance() / static_cast<double>(moments.count());
}

/// Second moments of the samples of an estimate: as observed, and as expected for
/// `expected_samples` samples.
struct SampleMoments {
    double samples;
    const SecondMoment& seen;
    double expected_samples;
    const SecondMoment& expected;
};

/// Returns the part of a mean's variance that its spread lacks: that of rare samples, a single one
/// of which moves the mean too much, as far as fewer occurred than expected.
double unseen_variance(const SampleMoments& of, double sample_variance)
{
    const double size = rare_fraction * std::sqrt(sample_variance) * of.samples;
    const double unseen =
        of.expected.above(size) / of.expected_samples - of.seen.above(size) / of.samples;
    return std::max(unseen, 0.0) / of.samples;
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
        case IntegratorKind::vcm:
            return sums.all.second_moment;
        default:
            return sums.lt;
    }
}

/// Compares both sides of `found`, which are from the same samples: evidence of a strategy, or of
/// merging.
template <typename PairedEvidence>
MeanComparison compare_paired(const PairedEvidence& found, double samples)
{
    const double variance = squared_error(found.difference);
    const double rare = unseen_variance({.samples = samples,
                                         .seen = found.sums.seen,
                                         .expected_samples = samples,
                                         .expected = found.sums.second_moment},
                                        variance);
    return compare_means({.found = found.sums.tested / samples,
                          .expected = found.sums.expected / samples,
                          .sample_variance = variance,
                          .rare_variance = rare,
                          .freedom = static_cast<double>(found.difference.count() - 1)});
}

}  // namespace

MeanComparison compare_strategy(const Evidence& evidence, std::size_t cell, std::size_t index)
{
    return compare_paired(evidence.strategy(cell, index), evidence.bdpt_samples_in(cell));
}

MeanComparison compare_integrator(const Evidence& evidence, std::size_t cell, int edges,
                                  std::size_t integrator)
{
    const LengthEvidence& length = evidence.length(cell, edges);
    const IntegratorKind kind = other_integrators[integrator];
    const bool from_light = kind == IntegratorKind::lt;
    const bool all = kind == IntegratorKind::vcm;
    const ReachSums& reach = all          ? length.sums.all
                             : from_light ? length.sums.from_light
                                          : length.sums.from_camera;
    const Moments& expected = all          ? length.radiance
                              : from_light ? length.from_light
                                           : length.from_camera;
    const Moments& found = length.others[integrator];
    const double variance = squared_error(found) + squared_error(expected);
    const double samples = evidence.bdpt_samples_in(cell);
    const double own_samples = samples / bdpt_samples * count_samples(kind, edges);
    const double rare = unseen_variance({.samples = own_samples,
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

MeanComparison compare_merges(const Evidence& evidence, int edges)
{
    return compare_paired(evidence.merges(edges),
                          evidence.samples_in(evidence.whole(), IntegratorKind::vcm, edges));
}

}  // namespace bdpt::eval
