#pragma once

#include <bdpt/eval/statistics.h>
#include <bdpt/types.h>

#include <cmath>
#include <cstdint>
#include <random>

namespace bdpt::test {

/// Reproducible random numbers with the renderer's 24-bit resolution.
class Random {
public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}

    /// Returns a number uniform in [0, 1).
    [[nodiscard]] float next() { return static_cast<float>(engine_() >> 40U) * 0x1p-24f; }

    [[nodiscard]] Vec2 next_2d()
    {
        const float x = next();
        return {x, next()};
    }

    /// Returns a unit vector, uniform over the sphere.
    [[nodiscard]] Vec3 direction()
    {
        const double z = 2.0 * static_cast<double>(next()) - 1.0;
        const double phi = 6.283185307179586 * static_cast<double>(next());
        const double r = std::sqrt(1.0 - z * z);
        return Vec3(r * std::cos(phi), r * std::sin(phi), z);
    }

private:
    std::mt19937_64 engine_;
};

using eval::Moments;

/// Returns the significance of one of `tests` independent tests that together have `significance`
/// [Sidak 1967].
[[nodiscard]] inline double sidak(double significance, int tests)
{
    return -std::expm1(std::log1p(-significance) / tests);
}

/// Returns Q(a, x), the regularised upper incomplete gamma function: power series below a + 1,
/// continued fraction by Lentz's method above [Abramowitz and Stegun 1964, 6.5.29 and 6.5.31].
[[nodiscard]] inline double upper_gamma(double a, double x)
{
    if (x <= 0.0) {
        return 1.0;
    }
    constexpr double epsilon = 1e-15;
    const double front = std::exp(a * std::log(x) - x - std::lgamma(a));
    if (x < a + 1.0) {
        double term = 1.0 / a;
        double sum = term;
        for (double n = a + 1.0; term > sum * epsilon; n += 1.0) {
            term *= x / n;
            sum += term;
        }
        return 1.0 - sum * front;
    }
    constexpr double tiny = 1e-300;
    double b = x + 1.0 - a;
    double c = 1.0 / tiny;
    double d = 1.0 / b;
    double fraction = d;
    for (int n = 1; n < 100000; ++n) {
        const double numerator = -n * (n - a);
        b += 2.0;
        d = numerator * d + b;
        d = 1.0 / (std::abs(d) < tiny ? tiny : d);
        c = b + numerator / c;
        c = std::abs(c) < tiny ? tiny : c;
        fraction *= d * c;
        if (std::abs(d * c - 1.0) < epsilon) {
            break;
        }
    }
    return fraction * front;
}

/// Returns the probability that a standard normal number is at least as far from 0 as `z`.
[[nodiscard]] inline double two_sided_p(double z)
{
    return std::erfc(std::abs(z) / std::sqrt(2.0));
}

}  // namespace bdpt::test
