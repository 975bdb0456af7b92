#pragma once

#include <bdpt/eval/statistics/moments.h>
#include <bdpt/eval/verify/verify_report.h>

#include <cstddef>

namespace bdpt::eval {

/// Means that differ by less than this fraction of the expected one are not told apart: rounding of
/// single floats has an influence, too.
constexpr double indifference = 1e-4;

/// What is known about the difference of two means.
struct Difference {
    double found = 0.0;
    double expected = 0.0;
    /// Variance of the difference, as the spread of the batches says.
    double sample_variance = 0.0;
    /// What samples add to that which are so bright that they have not turned up yet as often as
    /// all strategies together expect.
    double rare_variance = 0.0;
    double freedom = 1.0;  ///< degrees of freedom of `sample_variance`
};

/// Samples are rare if a single one moves the mean by more than this fraction of its standard
/// error: the spread of 400 equal ones is about as sure as the test needs it to be.
constexpr double rare_fraction = 0.05;

/// Welch's t-test [Welch 1947]. p is that of Student's t, or the bound 2 exp(-z^2 / 2) if that is
/// greater; means of numbers that are not negative keep it below their expectation whatever their
/// distribution [Maurer 2003]. No correction for other tests yet.
[[nodiscard]] MeanComparison compare_means(const Difference& difference);

/// Degrees of freedom of the difference of two independent means [Welch 1947].
[[nodiscard]] double welch_freedom(const Moments& a, const Moments& b);

/// z at which a test of a family of `tests` fails at the latest, with `false_alarm` for all of it.
[[nodiscard]] double critical_z(double false_alarm, std::size_t tests);

/// The difference in standard errors beyond which 90 % of all results are beyond the critical z.
/// The errors are estimates with so many degrees of freedom, and vary by a fraction (2
/// freedom)^-1/2.
[[nodiscard]] double detectable_z(double critical, double freedom);

}  // namespace bdpt::eval
