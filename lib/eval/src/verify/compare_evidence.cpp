#include "verify/compare_evidence.h"

#include <algorithm>
#include <cmath>

namespace bdpt::eval {
namespace {

double squared_error(const Moments& moments)
{
    return moments.variance() / static_cast<double>(moments.count());
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

/// Samples of one side of a comparison whose sides have the same expectation, as they were found.
struct Side {
    double samples;
    Contributions found;

    [[nodiscard]] double mean() const { return found.sum / samples; }
    /// Equal contributions whose sum has the same relative error.
    [[nodiscard]] double count() const
    {
        return found.squares > 0.0 ? found.sum * found.sum / found.squares : 0.0;
    }
};

/// Variance of the difference of two means where roulette may have ended walks. It stands in no
/// density, so how rare its survivors are, and how bright, is known from those alone that were
/// found: n equal ones have a relative error of n^-1/2, of the greater mean, as that of too few is
/// too small. 0 for what has been found often enough for the spread to be relied on.
double variance_by_count(const Side& a, const Side& b)
{
    constexpr double enough = 1.0 / (rare_fraction * rare_fraction);
    const double mean = std::max(a.mean(), b.mean());
    double relative = 0.0;
    for (const double count : {a.count(), b.count()}) {
        relative += count < enough ? 1.0 / (count + 1.0) : 0.0;
    }
    return mean * mean * relative;
}

/// Roulette ends walks to paths of this length.
bool has_roulette(int edges)
{
    return edges > roulette_start;
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

}  // namespace

MeanComparison compare_strategy(const Evidence& evidence, std::size_t cell, std::size_t index)
{
    const StrategyEvidence& found = evidence.strategy(cell, index);
    const double samples = evidence.bdpt_samples_in(cell);
    const double variance = squared_error(found.difference);
    double rare = unseen_variance({.samples = samples,
                                   .seen = found.sums.seen,
                                   .expected_samples = samples,
                                   .expected = found.sums.second_moment},
                                  variance);
    if (has_roulette(evidence.row().edges(index))) {
        const double by_count = variance_by_count({.samples = samples, .found = found.sums.own},
                                                  {.samples = samples, .found = found.sums.others});
        rare = std::max(rare, by_count - variance);
    }
    return compare_means({.found = found.sums.tested / samples,
                          .expected = found.sums.expected / samples,
                          .sample_variance = variance,
                          .rare_variance = rare,
                          .freedom = static_cast<double>(found.difference.count() - 1)});
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
    const double samples = evidence.bdpt_samples_in(cell);
    const double own_samples = samples / bdpt_samples * samples_of(kind, edges);
    double rare = unseen_variance({.samples = own_samples,
                                   .seen = length.seen[integrator],
                                   .expected_samples = samples,
                                   .expected = second_moment(length.sums, kind)},
                                  variance) +
                  unseen_variance({.samples = samples,
                                   .seen = reach.seen,
                                   .expected_samples = samples,
                                   .expected = reach.second_moment},
                                  variance);
    if (has_roulette(edges)) {
        const double by_count = variance_by_count(
            {.samples = own_samples,
             .found = {.sum = found.mean() * own_samples,
                       .squares = length.seen[integrator].of_all()}},
            {.samples = samples, .found = {.sum = reach.radiance, .squares = reach.seen.of_all()}});
        rare = std::max(rare, by_count - variance);
    }
    return compare_means({.found = found.mean(),
                          .expected = reach.radiance / samples,
                          .sample_variance = variance,
                          .rare_variance = rare,
                          .freedom = welch_freedom(found, expected)});
}

}  // namespace bdpt::eval
