#include "math/elementary.h"

#include "catch.hpp"
#include "statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace bdpt::test::elementary_test {
namespace {

constexpr int steps = 400000;

/// Evenly spaced in [from, to].
float at(int i, float from, float to)
{
    return from + (to - from) * (static_cast<float>(i) / static_cast<float>(steps));
}

}  // namespace

TEST_CASE("sin_cos is within 1e-6 up to 1e4 and beyond")
{
    for (const float range : {1.0f, 10.0f, 1e4f, 1e7f}) {
        CAPTURE(range);
        double worst = 0.0;
        for (int i = 0; i <= steps; ++i) {
            const float x = at(i, -range, range);
            const SinCos value = sin_cos(x);
            const double exact = static_cast<double>(x);
            worst = std::max(worst, std::abs(static_cast<double>(value.sin) - std::sin(exact)));
            worst = std::max(worst, std::abs(static_cast<double>(value.cos) - std::cos(exact)));
        }
        CHECK(worst < 2e-7);
    }
}

TEST_CASE("sin_cos keeps small angles and survives bad ones")
{
    CHECK(sin_cos(1e-20f).sin == 1e-20f);
    CHECK(sin_cos(0.0f).cos == 1.0f);
    for (const float bad :
         {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN(),
          std::numeric_limits<float>::max()}) {
        CHECK(sin_cos(bad).sin == 0.0f);
        CHECK(sin_cos(bad).cos == 1.0f);
    }
}

TEST_CASE("atan2_exact is within 1e-6 in all quadrants")
{
    double worst = 0.0;
    for (int i = 0; i <= steps; ++i) {
        const auto angle = static_cast<double>(at(i, -3.14159f, 3.14159f));
        const double radius = i % 3 == 0 ? 1e-15 : (i % 3 == 1 ? 1.0 : 1e15);
        const auto y = static_cast<float>(radius * std::sin(angle));
        const auto x = static_cast<float>(radius * std::cos(angle));
        const double exact = std::atan2(static_cast<double>(y), static_cast<double>(x));
        worst = std::max(worst, std::abs(static_cast<double>(atan2_exact(y, x)) - exact));
    }
    CHECK(worst < 5e-7);
    CHECK(atan2_exact(0.0f, 0.0f) == 0.0f);
    CHECK(atan2_exact(0.0f, -1.0f) == pi);
    CHECK(atan2_exact(-1.0f, 0.0f) == Approx(-0.5f * pi));
}

TEST_CASE("acos_exact is within 1e-6 and clamps")
{
    double worst = 0.0;
    for (int i = 0; i <= steps; ++i) {
        const float c = at(i, -1.0f, 1.0f);
        const double exact = std::acos(static_cast<double>(c));
        worst = std::max(worst, std::abs(static_cast<double>(acos_exact(c)) - exact));
    }
    CHECK(worst < 5e-7);
    CHECK(acos_exact(1.5f) == 0.0f);
    CHECK(acos_exact(-1.5f) == Approx(pi));
    // Small angles keep their digits.
    CHECK(acos_exact(1.0f - 0x1p-24f) == Approx(std::acos(1.0 - 0x1p-24)).epsilon(1e-6));
}

TEST_CASE("exp_exact is within 1e-6 of the value")
{
    double worst = 0.0;
    for (int i = 0; i <= steps; ++i) {
        const float x = at(i, -87.0f, 88.0f);
        const double exact = std::exp(static_cast<double>(x));
        worst = std::max(worst, std::abs(static_cast<double>(exp_exact(x)) / exact - 1.0));
    }
    CHECK(worst < 4e-7);
    CHECK(exp_exact(0.0f) == 1.0f);
    CHECK(exp_exact(-87.5f) == 0.0f);
    CHECK(exp_exact(-std::numeric_limits<float>::infinity()) == 0.0f);
    CHECK(std::isinf(exp_exact(88.5f)));
    CHECK(std::isnan(exp_exact(std::numeric_limits<float>::quiet_NaN())));
}

TEST_CASE("log_exact is within 1e-6 over all normal floats")
{
    test::Random random(1);
    double worst = 0.0;
    for (int i = 0; i <= steps; ++i) {
        const float x =
            std::ldexp(1.0f + random.next(), static_cast<int>(250.0f * random.next()) - 125);
        const double exact = std::log(static_cast<double>(x));
        worst = std::max(worst, std::abs(static_cast<double>(log_exact(x)) - exact) /
                                    std::max(1.0, std::abs(exact)));
    }
    CHECK(worst < 3e-7);
    CHECK(log_exact(1.0f) == 0.0f);
    CHECK(log_exact(1.0f + 0x1p-20f) == Approx(std::log1p(0x1p-20)).epsilon(1e-6));
}

}  // namespace bdpt::test::elementary_test
