#include <bdpt/eval/statistics.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "catch.hpp"
#include "statistics.h"

namespace bdpt::eval::statistics_test {
namespace {

TEST_CASE("Student's t distribution has the values of its closed forms")
{
    for (const double t : {0.1, 0.7, 1.0, 2.5, 12.0, 1000.0}) {
        CAPTURE(t);
        // One degree of freedom is Cauchy's distribution; for two and four the integral is
        // algebraic.
        CHECK(student_two_sided_p(t, 1) ==
              Approx(2.0 / std::numbers::pi * std::atan(1.0 / t)).epsilon(1e-10));
        CHECK(student_two_sided_p(-t, 2) ==
              Approx(2.0 / (2.0 + t * t) / (1.0 + t / std::sqrt(2.0 + t * t))).epsilon(1e-9));
        const double u = t / std::sqrt(4.0 + t * t);
        const double rest = 4.0 / (4.0 + t * t) / (1.0 + u);  // 1 - u without cancellation
        CHECK(student_two_sided_p(t, 4) == Approx(rest * rest * (1.0 + 0.5 * u)).epsilon(1e-9));
    }
    CHECK(student_two_sided_p(0.0, 3) == 1.0);
    CHECK(student_two_sided_p(std::numeric_limits<double>::infinity(), 3) == 0.0);
    // Many degrees of freedom are the normal distribution.
    CHECK(student_two_sided_p(1.96, 1e7) == Approx(test::two_sided_p(1.96)).epsilon(1e-5));
}

TEST_CASE("a mean is tested against 0")
{
    Moments moments;
    moments.add(1.0);
    CHECK_FALSE(test_zero_mean(moments));
    moments.add(2.0);
    moments.add(3.0);
    // Mean 2, variance 1, standard error 1 / sqrt(3): t = 3.4641 with 2 degrees of freedom.
    const auto test = test_zero_mean(moments);
    REQUIRE(test);
    CHECK(test->t == Approx(std::sqrt(12.0)));
    CHECK(test->p == Approx(1.0 - std::sqrt(12.0 / 14.0)));
}

TEST_CASE("equal numbers differ from 0 for sure, or not at all")
{
    Moments zeros;
    Moments twos;
    for (int i = 0; i < 3; ++i) {
        zeros.add(0.0);
        twos.add(-2.0);
    }
    CHECK(test_zero_mean(zeros)->t == 0.0);
    CHECK(test_zero_mean(zeros)->p == 1.0);
    CHECK(std::isinf(test_zero_mean(twos)->t));
    CHECK(test_zero_mean(twos)->t < 0.0);
    CHECK(test_zero_mean(twos)->p == 0.0);
}

TEST_CASE("Holm's correction steps down through the tests")
{
    // Sorted 0.01, 0.02, 0.03, 0.5 times 4, 3, 2, 1 is 0.04, 0.06, 0.06, 0.5.
    const std::vector<double> adjusted = holm_adjusted(std::vector{0.03, 0.01, 0.5, 0.02});
    CHECK(adjusted[0] == Approx(0.06));
    CHECK(adjusted[1] == Approx(0.04));
    CHECK(adjusted[2] == Approx(0.5));
    CHECK(adjusted[3] == Approx(0.06));
    // Never less than that of a surer test, never more than 1.
    const std::vector<double> steps = holm_adjusted(std::vector{0.4, 0.3});
    CHECK(steps[0] == Approx(0.6));
    CHECK(steps[1] == Approx(0.6));
    CHECK(holm_adjusted(std::vector{0.9, 0.8})[0] == 1.0);
    CHECK(holm_adjusted({}).empty());
}

TEST_CASE("the error of a mean comes from blocks")
{
    // Blocks of 2 x 2 with sums 4 and 12 about a mean of 2: deviations -4 and 4, so the estimate is
    // sqrt(2 / 1 * 32) / 8 = 1.
    const std::vector<double> values{1, 1, 3, 3,  //
                                     1, 1, 3, 3};
    CHECK(block_standard_error(values, 4, 2, 2).value() == Approx(1.0));
    // As single pixels the eight deviations of 1 give sqrt(8 / 7 * 8) / 8.
    CHECK(block_standard_error(values, 4, 2, 1).value() == Approx(std::sqrt(64.0 / 7) / 8));
    // One block tells nothing.
    CHECK(block_standard_error(values, 4, 2, 4) == std::nullopt);
    // A cut block: 1, 1 and 4 alone about a mean of 2.
    CHECK(block_standard_error(std::vector{1.0, 1.0, 4.0}, 3, 1, 2).value() ==
          Approx(std::sqrt(2.0 * (4.0 + 4.0)) / 3));
}

TEST_CASE("blocks see that neighbours depend on each other")
{
    // Noise that is the same in squares of 4 x 4 pixels: the error of the mean is that of 256
    // numbers, not of 4096.
    constexpr int side = 64;
    test::Random random(5);
    std::vector<double> cells;
    for (int i = 0; i < 256; ++i) {
        cells.push_back(static_cast<double>(random.next()));
    }
    std::vector<double> values;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            values.push_back(cells[static_cast<std::size_t>(y / 4 * 16 + x / 4)]);
        }
    }
    const double expected = std::sqrt(1.0 / 12.0 / 256.0);
    CHECK(block_standard_error(values, side, side, 8).value() == Approx(expected).epsilon(0.25));
    CHECK(block_standard_error(values, side, side, 1).value() < 0.35 * expected);
}

}  // namespace
}  // namespace bdpt::eval::statistics_test
