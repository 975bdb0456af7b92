#include "chi_square.h"

#include "catch.hpp"

#include <array>

namespace bdpt::test::chi_square_test {

// The tools that judge the rest.

TEST_CASE("upper_gamma has the tabulated quantiles of chi-square")
{
    // 95th percentiles [Abramowitz and Stegun 1964, table 26.8]
    CHECK(upper_gamma(0.5, 0.5 * 3.84146) == Approx(0.05).epsilon(1e-4));
    CHECK(upper_gamma(5.0, 0.5 * 18.3070) == Approx(0.05).epsilon(1e-4));
    CHECK(upper_gamma(50.0, 0.5 * 124.342) == Approx(0.05).epsilon(1e-4));
    CHECK(upper_gamma(1.0, 2.5) == Approx(std::exp(-2.5)).epsilon(1e-12));
    CHECK(two_sided_p(1.959964) == Approx(0.05).epsilon(1e-5));
    CHECK(sidak(0.01, 100) == Approx(0.01 / 100).epsilon(0.01));
}

TEST_CASE("chi_square accepts right counts and rejects wrong ones")
{
    const std::array<double, 4> probabilities{0.1, 0.2, 0.3, 0.4};
    const std::array<double, 4> right{1010, 1985, 3020, 3985};
    const std::array<double, 4> wrong{1200, 1900, 2900, 4000};
    CHECK(chi_square(right, probabilities).p_value > 0.1);
    CHECK(chi_square(wrong, probabilities).p_value < 1e-6);
    CHECK(chi_square(right, probabilities).degrees == 3);
}

TEST_CASE("chi_square rejects a count where nothing can be")
{
    const std::array<double, 3> probabilities{0.5, 0.5, 0.0};
    const std::array<double, 3> counts{5000, 5000, 1};
    CHECK(chi_square(counts, probabilities).p_value == 0.0);
}

TEST_CASE("chi_square says what it cannot see")
{
    const std::array<double, 2> probabilities{0.5, 0.5};
    const std::array<double, 2> few{50, 50};
    const std::array<double, 2> many{500000, 500000};
    CHECK(chi_square(few, probabilities).min_detectable(0.01) > 0.3);
    CHECK(chi_square(many, probabilities).min_detectable(0.01) < 0.01);
}

}  // namespace bdpt::test::chi_square_test
