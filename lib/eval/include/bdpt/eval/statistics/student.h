#pragma once

/// @file
/// Tests whether a mean is 0.
///
/// @code{.cpp}
/// bool is_biased(const bdpt::eval::Moments& differences)
/// {
///     const auto test = bdpt::eval::test_zero_mean(differences);
///     return test && test->p < 0.001;
/// }
/// @endcode

#include <bdpt/eval/statistics/moments.h>
#include <bdpt/export.h>

#include <optional>

namespace bdpt::eval {

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

}  // namespace bdpt::eval
