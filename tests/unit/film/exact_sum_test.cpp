#include <bdpt/film/exact_sum.h>

#include "catch.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <thread>
#include <vector>

namespace bdpt::exact_sum_test {
namespace {

double exact_sum(const std::vector<float>& values)
{
    long double sum = 0.0L;
    for (const float v : values) {
        sum += static_cast<long double>(v);
    }
    return static_cast<double>(sum);
}

ExactSum sum_of(const std::vector<float>& values)
{
    ExactSum sum;
    for (const float v : values) {
        sum.add(v);
    }
    return sum;
}

}  // namespace

TEST_CASE("ExactSum keeps 1e-5 of the sum from 1e-5 to fireflies of 1e12", "[film]")
{
    std::mt19937 engine(1);
    for (const float scale : {1e-5f, 1.0f, 1e4f, 1e9f}) {
        std::exponential_distribution<float> distribution(1.0f / scale);
        std::vector<float> values;
        for (int i = 0; i < 20000; ++i) {
            values.push_back(distribution(engine));
        }
        CHECK(sum_of(values).value() == Approx(exact_sum(values)).epsilon(1e-6));
        values.push_back(1e12f);
        CHECK(sum_of(values).value() == Approx(exact_sum(values)).epsilon(1e-6));
    }
}

TEST_CASE("ExactSum does not lose many tiny splats next to a firefly", "[film]")
{
    ExactSum sum;
    constexpr float tiny = 1e-9f;
    sum.add(1e12f);
    for (int i = 0; i < 1000; ++i) {
        sum.add(tiny);
    }
    ExactSum firefly;
    firefly.add(1e12f);
    ExactSum only_tiny;
    for (int i = 0; i < 1000; ++i) {
        only_tiny.add(tiny);
    }
    firefly.add(only_tiny);
    CHECK(sum == firefly);
    CHECK(only_tiny.value() == Approx(1000.0 * static_cast<double>(tiny)).epsilon(1e-5));
}

TEST_CASE("ExactSum holds 2^24 fireflies of 1e12", "[film]")
{
    ExactSum sum;
    sum.add(1e12f);
    const double one = sum.value();
    for (int i = 0; i < 24; ++i) {
        const ExactSum copy = sum;
        sum.add(copy);  // doubles it
    }
    CHECK(sum.value() == std::ldexp(one, 24));
}

TEST_CASE("ExactSum is the same for every order and any threads", "[film]")
{
    std::mt19937 engine(7);
    std::lognormal_distribution<float> distribution(0.0f, 6.0f);
    std::vector<float> values;
    for (int i = 0; i < 4000; ++i) {
        values.push_back(std::min(distribution(engine), ExactSum::max_value));
    }
    const ExactSum expected = sum_of(values);
    std::shuffle(values.begin(), values.end(), engine);
    CHECK(sum_of(values) == expected);

    ExactSum shared;
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < 4; ++t) {
        threads.emplace_back([&, t] {
            for (std::size_t i = t; i < values.size(); i += 4) {
                shared.add(values[i]);
            }
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    CHECK(shared == expected);
}

TEST_CASE("ExactSum adds values of both signs exactly", "[film]")
{
    std::mt19937 engine(3);
    std::normal_distribution<float> exponent(0.0f, 6.0f);
    std::uniform_real_distribution<float> mantissa(-1.0f, 1.0f);
    std::vector<float> values;
    for (int i = 0; i < 5000; ++i) {
        values.push_back(
            std::clamp(std::ldexp(mantissa(engine), static_cast<int>(exponent(engine))),
                       -ExactSum::max_value, ExactSum::max_value));
    }
    const ExactSum expected = sum_of(values);
    CHECK(expected.value() == Approx(exact_sum(values)).epsilon(1e-9));
    std::shuffle(values.begin(), values.end(), engine);
    CHECK(sum_of(values) == expected);
    // Taking everything off again leaves zero, to the bit.
    ExactSum nothing = expected;
    for (const float v : values) {
        nothing.add(-v);
    }
    CHECK(nothing == ExactSum{});
    CHECK(nothing.value() == 0.0);
}

TEST_CASE("ExactSum keeps the digits of small negative sums and of large ones", "[film]")
{
    ExactSum sum;
    sum.add(-3e-7f);
    CHECK(sum.value() == Approx(-3e-7).epsilon(1e-6));
    sum.add(1e12f);
    sum.add(-1e12f);
    CHECK(sum.value() == Approx(-3e-7).epsilon(1e-6));
    ExactSum low;
    low.add(-ExactSum::max_value);
    for (int i = 0; i < 24; ++i) {
        const ExactSum copy = low;
        low.add(copy);
    }
    CHECK(low.value() == -std::ldexp(1.0, 66));
    ExactSum high;
    high.add(ExactSum::max_value);
    for (int i = 0; i < 24; ++i) {
        const ExactSum copy = high;
        high.add(copy);
    }
    CHECK(high.value() == std::ldexp(1.0, 66));
    high.add(low);
    CHECK(high == ExactSum{});
}

TEST_CASE("ExactSum of both signs is the same for any threads", "[film]")
{
    std::mt19937 engine(9);
    std::normal_distribution<float> distribution(0.0f, 100.0f);
    std::vector<float> values(4000);
    for (float& v : values) {
        v = distribution(engine);
    }
    ExactSum shared;
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < 4; ++t) {
        threads.emplace_back([&, t] {
            for (std::size_t i = t; i < values.size(); i += 4) {
                shared.add(values[i]);
            }
        });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
    CHECK(shared == sum_of(values));
}

}  // namespace bdpt::exact_sum_test
