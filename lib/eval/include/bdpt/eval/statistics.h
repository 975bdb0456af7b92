#pragma once

/// @file
/// Statistics of errors: means and medians, tests whether a mean is 0, corrections for many tests,
/// and standard errors of values that depend on their neighbours.
///
/// @code{.cpp}
/// bdpt::eval::Moments errors;
/// for (const double error : {0.11, 0.09, 0.10}) {
///     errors.add(error);
/// }
/// std::cout << errors.mean() << " +- " << errors.standard_error() << '\n';
/// @endcode
///
/// @code{.cpp}
/// bool is_biased(const bdpt::eval::Moments& differences)
/// {
///     const auto test = bdpt::eval::test_zero_mean(differences);
///     return test && test->p < 0.001;
/// }
/// @endcode
///
/// @code{.cpp}
/// const std::vector<double> p = {0.01, 0.2, 0.04};
/// const std::vector<double> adjusted = bdpt::eval::holm_adjusted(p);  // 0.03, 0.2, 0.08
/// @endcode

#include <bdpt/export.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace bdpt::eval {

/// Running mean and variance of a stream of numbers [Welford 1962].
class Moments {
public:
    void add(double x)
    {
        ++count_;
        const double delta = x - mean_;
        mean_ += delta / static_cast<double>(count_);
        squares_ += delta * (x - mean_);
    }

    [[nodiscard]] std::int64_t count() const { return count_; }
    [[nodiscard]] double mean() const { return mean_; }
    /// Returns the unbiased variance; needs two numbers.
    [[nodiscard]] double variance() const { return squares_ / static_cast<double>(count_ - 1); }
    /// Returns the standard error of the mean.
    [[nodiscard]] double standard_error() const
    {
        return std::sqrt(variance() / static_cast<double>(count_));
    }

private:
    std::int64_t count_ = 0;
    double mean_ = 0.0;
    double squares_ = 0.0;
};

/// Returns the probability that a variable of Student's t distribution with `freedom` > 0 degrees
/// of freedom is at least as far from 0 as `t`.
[[nodiscard]] BDPT_EXPORT double student_two_sided_p(double t, double freedom);

/// Outcome of a t-test of one mean.
struct MeanTest {
    double t = 0.0;  ///< distance from 0 in standard errors; infinite when all numbers are equal
    double p = 1.0;  ///< probability of that distance, or a greater one, if the true mean is 0
};

/// Tests whether the mean is 0 [Student 1908]; returns none with fewer than two numbers.
[[nodiscard]] BDPT_EXPORT std::optional<MeanTest> test_zero_mean(const Moments& moments);

/// Returns adjusted p-values of many tests, in their order: if the tests with an adjusted p of at
/// most a are taken as significant, the probability of any false positive is at most a [Holm 1979].
[[nodiscard]] BDPT_EXPORT std::vector<double> holm_adjusted(std::span<const double> p);

/// Median and range of some numbers.
struct Spread {
    double median = 0.0;
    double least = 0.0;
    double greatest = 0.0;
};

/// Returns the spread of at least one number; the median of an even count is the mean of the two in
/// the middle.
[[nodiscard]] BDPT_EXPORT Spread spread(std::vector<double> values);

/// Returns the standard error of the mean of `width` x `height` values, row-major, whose neighbours
/// are correlated, as noise is by a pixel filter. It is estimated from the sums over blocks of
/// `block` x `block` values, which must be larger than the correlation length [the linearised
/// estimator for clusters, Cochran 1977, ch. 9A]. Returns none if there is only one block.
[[nodiscard]] BDPT_EXPORT std::optional<double> block_standard_error(std::span<const double> values,
                                                                     int width, int height,
                                                                     int block);

}  // namespace bdpt::eval
