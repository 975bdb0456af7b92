#include "rates/rate_map.h"

#include "catch.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt::test::fitting_exponents_test {
namespace {

double mean_rate(const std::vector<std::int8_t>& exponents, const std::vector<std::int64_t>& pixels)
{
    double sum = 0.0;
    double count = 0.0;
    for (std::size_t i = 0; i < exponents.size(); ++i) {
        const auto n = pixels.empty() ? 1.0 : static_cast<double>(pixels[i]);
        sum += n * static_cast<double>(SampleRates::to_rate(exponents[i]));
        count += n;
    }
    return sum / count;
}

Plane half_and_half(double first, double second)
{
    Plane wanted(1000, first);
    std::fill(wanted.begin() + 500, wanted.end(), second);
    return wanted;
}

}  // namespace

TEST_CASE("exponents are in proportion to what is wanted, with a mean rate of 1", "[rates]")
{
    const std::vector<std::int8_t> exponents = fitting_exponents(half_and_half(1.0, 2.0), {});
    CHECK(mean_rate(exponents, {}) <= 1.0);
    CHECK(mean_rate(exponents, {}) > 0.99);
    // Twice as much for the second half: rates 1/2 and 1, and what is left for some of each.
    CHECK(*std::min_element(exponents.begin(), exponents.begin() + 500) == -1);
    CHECK(*std::max_element(exponents.begin(), exponents.begin() + 500) <= 0);
    CHECK(*std::min_element(exponents.begin() + 500, exponents.end()) == 0);
    CHECK(*std::max_element(exponents.begin() + 500, exponents.end()) == 1);
}

TEST_CASE("exponents stay in their range", "[rates]")
{
    const std::vector<std::int8_t> wide = fitting_exponents(half_and_half(1.0, 100.0), {});
    CHECK(wide.front() == -2);
    CHECK(wide.back() >= 0);
    const std::vector<std::int8_t> narrow =
        fitting_exponents(half_and_half(1.0, 100.0), {}, {.min = -1, .max = 1});
    CHECK(narrow.front() == -1);
    CHECK(*std::max_element(narrow.begin(), narrow.end()) == 1);
    CHECK(mean_rate(narrow, {}) > 0.99);
    // No rates of this range have a mean of 1.
    const std::vector<std::int8_t> low =
        fitting_exponents(half_and_half(1.0, 100.0), {}, {.min = -2, .max = -1});
    CHECK(mean_rate(low, {}) == 0.5);
}

TEST_CASE("elements of many pixels count as often", "[rates]")
{
    // The first ten elements have as many pixels as the other 90.
    Plane wanted(100, 1.0);
    std::fill(wanted.begin(), wanted.begin() + 10, 3.0);
    std::vector<std::int64_t> pixels(100, 10);
    std::fill(pixels.begin(), pixels.begin() + 10, 90);
    const std::vector<std::int8_t> exponents = fitting_exponents(wanted, pixels);
    CHECK(mean_rate(exponents, pixels) <= 1.0);
    CHECK(mean_rate(exponents, pixels) > 0.95);
    CHECK(exponents.back() < exponents.front());
    // If each counted once, there would be enough for a rate of 2.
    CHECK(fitting_exponents(wanted, {}).front() == 1);
    CHECK(*std::min_element(exponents.begin(), exponents.begin() + 10) == 0);
}

TEST_CASE("equal wishes get a rate of 1", "[rates]")
{
    for (const double wish : {1e-9, 1.0, 1e9}) {
        for (const std::int8_t exponent : fitting_exponents(Plane(64, wish), {})) {
            CHECK(exponent == 0);
        }
    }
}

}  // namespace bdpt::test::fitting_exponents_test
