#pragma once

#include <bdpt/eval/statistics.h>
#include <bdpt/eval/verify.h>

#include <cstddef>

#include "verify/evidence.h"

namespace bdpt::eval {

/// Means that differ by less than this fraction of the expected one count as equal, as rounding to
/// single precision contributes, too.
constexpr double indifference = 1e-4;

/// Statistics of the difference of two means.
struct Difference {
    double found = 0.0;
    double expected = 0.0;
    /// Variance of the difference, from the spread of the batches.
    double sample_variance = 0.0;
    /// Additional variance of samples so bright that they have not occurred yet as often as all
    /// strategies together predict.
    double rare_variance = 0.0;
    double freedom = 1.0;  ///< degrees of freedom of `sample_variance`
};

/// Samples are rare if a single one moves the mean by more than this fraction of its standard
/// error: the spread of 400 equal samples is about as accurate as the test needs.
constexpr double rare_fraction = 0.05;

/// Performs Welch's t-test [Welch 1947]. p is that of Student's t, or the bound 2 exp(-z^2 / 2) if
/// that is greater; means of non-negative numbers obey this bound below their expectation for every
/// distribution [Maurer 2003]. Not yet corrected for other tests.
[[nodiscard]] MeanComparison compare_means(const Difference& difference);

/// Returns the degrees of freedom of the difference of two independent means [Welch 1947].
[[nodiscard]] double welch_freedom(const Moments& a, const Moments& b);

/// Returns the z at which a test of a family of `tests` fails at the latest, with `false_alarm` for
/// the whole family.
[[nodiscard]] double critical_z(double false_alarm, std::size_t tests);

/// Returns the difference in standard errors at which 90 % of all results are beyond the critical
/// z. The errors are estimates with `freedom` degrees of freedom, and vary by a fraction (2
/// freedom)^-1/2.
[[nodiscard]] double detectable_z(double critical, double freedom);

/// Compares the tested estimate of a strategy with the expected one, in a cell.
[[nodiscard]] MeanComparison compare_strategy(const Evidence& evidence, std::size_t cell,
                                              std::size_t index);

/// Compares one of `other_integrators` with the paths of bdpt that it can sample, in a cell.
[[nodiscard]] MeanComparison compare_integrator(const Evidence& evidence, std::size_t cell,
                                                int edges, std::size_t integrator);

/// Compares the tested estimate of merging with the expected one, in the whole image.
[[nodiscard]] MeanComparison compare_merges(const Evidence& evidence, int edges);

/// Samples of bdpt in the whole image from which on detectability can be trusted. With fewer,
/// ordinary samples look like rare ones, and an error raises the noise that it hides in.
constexpr double trusted_samples = 262144.0;

/// Fills in the detectable error of each comparison, and returns the worst of all strategies:
/// relative errors of the image's mean that are found with a probability of 90 %. A difference is
/// found from `distance` standard errors on.
[[nodiscard]] double find_detectable(const Evidence& evidence, VerifyReport& report,
                                     double distance);

/// Returns the least relative error of merging that is found with a probability of 90 %.
[[nodiscard]] double find_detectable_of_merging(const Evidence& evidence,
                                                const VerifyReport& report, double distance);

/// Performs all tests on the evidence and returns the report with the verdict, except for its time.
/// Needs two batches.
[[nodiscard]] VerifyReport judge(const Evidence& evidence, const VerifyOptions& options);

/// Tests whether errors as small as `options` ask for would have been found.
[[nodiscard]] bool is_sharp(const VerifyReport& report, const VerifyOptions& options);

}  // namespace bdpt::eval
