#include <bdpt/eval/statistics.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>

namespace bdpt::eval {

namespace {

/// Evaluates the continued fraction of the incomplete beta function [DLMF 8.17.22], by Lentz's
/// method. Converges fast for x < (a + 1) / (a + b + 2).
double beta_fraction(double x, double a, double b)
{
    constexpr double tiny = 1e-300;
    constexpr double precision = 1e-15;
    const auto away_from_zero = [](double v) { return std::abs(v) < tiny ? tiny : v; };
    double c = 1.0;
    double d = 1.0 / away_from_zero(1.0 - (a + b) * x / (a + 1.0));
    double result = d;
    for (int step = 1; step < 10000; ++step) {
        const double m = step;
        const double even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        d = 1.0 / away_from_zero(1.0 + even * d);
        c = away_from_zero(1.0 + even / c);
        result *= c * d;
        const double odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        d = 1.0 / away_from_zero(1.0 + odd * d);
        c = away_from_zero(1.0 + odd / c);
        result *= c * d;
        if (std::abs(c * d - 1.0) < precision) {
            break;
        }
    }
    return result;
}

/// Returns I_x(a, b), the regularised incomplete beta function; `y` is 1 - x without its rounding
/// error.
double incomplete_beta(double x, double y, double a, double b)
{
    if (x <= 0.0) {
        return 0.0;
    }
    if (y <= 0.0) {
        return 1.0;
    }
    const double front = std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) +
                                  a * std::log(x) + b * std::log(y));
    return x < (a + 1.0) / (a + b + 2.0) ? front * beta_fraction(x, a, b) / a
                                         : 1.0 - front * beta_fraction(y, b, a) / b;
}

}  // namespace

double student_two_sided_p(double t, double freedom)
{
    if (std::isinf(t)) {
        return 0.0;
    }
    // [Abramowitz and Stegun 1964, 26.7.1 with 26.5.27]
    const double square = t * t;
    const double x = freedom / (freedom + square);
    const double y = square / (freedom + square);
    return std::clamp(incomplete_beta(x, y, 0.5 * freedom, 0.5), 0.0, 1.0);
}

std::optional<MeanTest> test_zero_mean(const Moments& moments)
{
    if (moments.count() < 2) {
        return std::nullopt;
    }
    if (moments.mean() == 0.0) {
        return MeanTest{.t = 0.0, .p = 1.0};
    }
    const double error = moments.standard_error();
    const double t = error > 0.0
                         ? moments.mean() / error
                         : std::copysign(std::numeric_limits<double>::infinity(), moments.mean());
    return MeanTest{.t = t, .p = student_two_sided_p(t, static_cast<double>(moments.count() - 1))};
}

std::vector<double> holm_adjusted(std::span<const double> p)
{
    std::vector<std::size_t> order(p.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [p](std::size_t a, std::size_t b) { return p[a] < p[b]; });
    std::vector<double> result(p.size());
    double greatest = 0.0;
    for (std::size_t rank = 0; rank < order.size(); ++rank) {
        const double adjusted = static_cast<double>(order.size() - rank) * p[order[rank]];
        greatest = std::max(greatest, std::min(adjusted, 1.0));
        result[order[rank]] = greatest;
    }
    return result;
}

Spread spread(std::vector<double> values)
{
    std::sort(values.begin(), values.end());
    const std::size_t upper = values.size() / 2;
    const std::size_t lower = (values.size() - 1) / 2;
    return {.median = 0.5 * (values[lower] + values[upper]),
            .least = values.front(),
            .greatest = values.back()};
}

std::optional<double> block_standard_error(std::span<const double> values, int width, int height,
                                           int block)
{
    const double count = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
    double blocks = 0.0;
    double squares = 0.0;
    for (int top = 0; top < height; top += block) {
        for (int left = 0; left < width; left += block) {
            double sum = 0.0;
            for (int y = top; y < std::min(top + block, height); ++y) {
                for (int x = left; x < std::min(left + block, width); ++x) {
                    sum += values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                                  static_cast<std::size_t>(x)] -
                           mean;
                }
            }
            squares += sum * sum;
            blocks += 1.0;
        }
    }
    if (blocks < 2.0) {
        return std::nullopt;
    }
    return std::sqrt(blocks / (blocks - 1.0) * squares) / count;
}

}  // namespace bdpt::eval
