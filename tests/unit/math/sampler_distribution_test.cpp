// How evenly the Sobol sampler's numbers lie, and that nothing but what should be even is.

#include "catch.hpp"
#include "chi_square.h"
#include "sampler_points.h"
#include "statistics.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <utility>

namespace bdpt::sampler_distribution_test {
namespace {

using test::half_points;
using test::Moments;
using test::numbers;
using test::SetKey;
using test::SetNumbers;

/// Are these 2^m points a (t, m, 2)-net in base 2: has each interval of area 2^(t - m) whose sides
/// are powers of two the same number of points? [Niederreiter 1992, "Random Number Generation and
/// Quasi-Monte Carlo Methods", ch. 4]
bool is_net(const std::vector<SetNumbers>& points, std::size_t a, std::size_t b, int t)
{
    const int m = std::countr_zero(points.size());
    for (int k = 0; k <= m - t; ++k) {
        const auto columns = std::size_t{1} << k;
        const auto rows = std::size_t{1} << (m - t - k);
        std::vector<int> counts(columns * rows);
        for (const SetNumbers& u : points) {
            const auto column = static_cast<std::size_t>(u[a] * static_cast<float>(columns));
            const auto row = static_cast<std::size_t>(u[b] * static_cast<float>(rows));
            ++counts[row * columns + column];
        }
        if (std::any_of(counts.begin(), counts.end(), [&](int c) { return c != 1 << t; })) {
            return false;
        }
    }
    return true;
}

using Integrand = double (*)(Vec2);

/// Smooth, not symmetric, not a product.
double smooth(Vec2 u)
{
    const double x = static_cast<double>(u.x);
    const double y = static_cast<double>(u.y);
    return std::exp(x * y) + x * std::sin(3.0 * y);
}

/// exp(xy) integrates to the sum of 1 / (k! (k + 1)^2).
double smooth_integral()
{
    double sum = 0.0;
    double factorial = 1.0;
    for (int k = 0; k < 20; ++k) {
        factorial *= std::max(k, 1);
        sum += 1.0 / (factorial * (k + 1) * (k + 1));
    }
    return sum + 0.5 * (1.0 - std::cos(3.0)) / 3.0;
}

double inside_circle(Vec2 u)
{
    return dot(u, u) < 1.0f ? 1.0 : 0.0;
}

/// Mean of f over some points of one half.
double estimate(const SetKey& key, Integrand f, std::int64_t half, std::int64_t count)
{
    double sum = 0.0;
    for (const SetNumbers& u : half_points(key, half, 0, count)) {
        sum += f({u[0], u[1]});
    }
    return sum / static_cast<double>(count);
}

/// Of estimates with `count` points each, over many pixels.
Moments estimates(SamplerKind kind, Integrand f, std::int64_t count, int pixels)
{
    Moments moments;
    for (int x = 0; x < pixels; ++x) {
        moments.add(estimate({.kind = kind, .seed = 5, .x = x}, f, x % 2, count));
    }
    return moments;
}

/// The parity of some of the leading four bits of u: +1 or -1. Its mean is zero.
double walsh(float u, std::uint32_t bits)
{
    const auto leading = static_cast<std::uint32_t>(u * 16.0f);
    return std::popcount(leading & bits) % 2 == 0 ? 1.0 : -1.0;
}

/// How much two sets know of each other, over many pixels: the largest mean square of the sum of
/// w(a) w(b) over 64 points, in units of what unrelated points give, for all Walsh functions of
/// four bits. Sets that share their order give 64, whatever their scrambles; unrelated sets at most
/// 2, as neighbouring points always fall into opposite halves.
double dependence(const std::function<std::pair<SetKey, SetKey>(int)>& sets_of_pixel,
                  std::int64_t half_a, std::int64_t half_b, std::size_t dim_a, std::size_t dim_b)
{
    constexpr int points = 64;
    constexpr int pixels = 500;
    std::array<std::array<double, 16>, 16> squares{};
    for (int x = 0; x < pixels; ++x) {
        const auto [key_a, key_b] = sets_of_pixel(x);
        const auto a = half_points(key_a, half_a, 0, points);
        const auto b = half_points(key_b, half_b, 0, points);
        for (std::uint32_t i = 1; i < 16; ++i) {
            for (std::uint32_t j = 1; j < 16; ++j) {
                double sum = 0.0;
                for (std::size_t k = 0; k < points; ++k) {
                    sum += walsh(a[k][dim_a], i) * walsh(b[k][dim_b], j);
                }
                squares[i][j] += sum * sum / points / pixels;
            }
        }
    }
    double most = 0.0;
    for (const auto& row : squares) {
        most = std::max(most, *std::max_element(row.begin(), row.end()));
    }
    return most;
}

}  // namespace

TEST_CASE("each half of a pixel's samples is a net in every set", "[sampler]")
{
    for (const std::int64_t half : {0, 1}) {
        for (const int x : {0, 1, 1000}) {
            for (int m = 0; m <= 8; ++m) {
                const std::int64_t count = std::int64_t{1} << m;
                // Blocks further on are nets too, also where indices have more than 16 bits.
                for (const std::int64_t block : {0, 1, 5, 65536, 1 << 20}) {
                    const auto points = half_points({.x = x}, half, block * count, count);
                    CAPTURE(half, x, m, block);
                    CHECK(is_net(points, 0, 1, 0));
                    CHECK(is_net(points, 1, 2, std::min(m, 1)));
                    CHECK(is_net(points, 0, 2, std::min(m, 1)));
                    for (const std::size_t d : {2U, 3U}) {
                        CHECK(is_net(points, d, d, m));
                    }
                }
            }
        }
    }
    CHECK_FALSE(is_net(half_points({.kind = SamplerKind::independent}, 0, 0, 16), 0, 1, 0));
}

TEST_CASE("every single dimension is stratified", "[sampler]")
{
    for (const std::int64_t half : {0, 1}) {
        for (int m = 0; m <= 10; ++m) {
            const std::int64_t count = std::int64_t{1} << m;
            const auto points = half_points({.seed = 9}, half, 3 * count, count);
            for (std::size_t d = 0; d < 4; ++d) {
                std::vector<int> hits(points.size());
                for (const SetNumbers& u : points) {
                    ++hits[static_cast<std::size_t>(u[d] * static_cast<float>(count))];
                }
                CHECK(hits == std::vector<int>(points.size(), 1));
            }
        }
    }
}

TEST_CASE("whoever takes more than four numbers gets the best pair of another set", "[sampler]")
{
    std::vector<SetNumbers> first;
    std::vector<SetNumbers> second;
    for (int i = 0; i < 64; ++i) {
        Sampler sampler(SamplerKind::sobol, 0, 3, 4, 2 * i);
        sampler.start(SampleUse::light_start);
        const Vec2 position = sampler.next_2d();
        const Vec2 choice = sampler.next_fine();
        const Vec2 direction = sampler.next_2d();
        first.push_back({position.x, position.y, choice.x, 0.0f});
        second.push_back({direction.x, direction.y, 0.0f, 0.0f});
    }
    CHECK(is_net(first, 0, 1, 0));
    CHECK(is_net(first, 1, 2, 1));
    CHECK(is_net(second, 0, 1, 0));
}

TEST_CASE("sets are not related", "[sampler]")
{
    using Keys = std::pair<SetKey, SetKey>;
    // 500 pixels: the mean square is known to 10 %, so a relation in 3 % of the pixels is seen.
    constexpr double unrelated = 2.8;
    const auto same_dimension = [&](auto other) {
        return dependence([&](int x) { return Keys{{.x = x}, other(x)}; }, 0, 0, 0, 0);
    };
    CHECK(same_dimension([](int x) { return SetKey{.x = x}; }) == Approx(64.0));
    CHECK(same_dimension([](int x) { return SetKey{.x = x + 1}; }) < unrelated);
    CHECK(same_dimension([](int x) { return SetKey{.x = x, .y = 1}; }) < unrelated);
    CHECK(same_dimension([](int x) { return SetKey{.seed = 1, .x = x}; }) < unrelated);
    CHECK(same_dimension([](int x) { return SetKey{.x = x, .vertex = 3}; }) < unrelated);
    CHECK(same_dimension([](int x) { return SetKey{.x = x, .use = SampleUse::next_event}; }) <
          unrelated);
    const auto itself = [](int x) { return Keys{{.x = x}, {.x = x}}; };
    const auto next = [](int x) { return Keys{{.x = x}, {.x = x, .vertex = 3}}; };
    for (std::size_t d = 0; d < 4; ++d) {
        CHECK(dependence(itself, 0, 1, d, d) < unrelated);
        CHECK(dependence(next, 0, 0, d, (d + 1) % 4) < unrelated);
    }
}

TEST_CASE("the mean of any number of samples is right", "[sampler]")
{
    constexpr int pixels = 40000;
    for (const auto kind : {SamplerKind::sobol, SamplerKind::independent}) {
        for (const std::int64_t count : {1, 2, 3, 7}) {
            const Moments moments = estimates(kind, smooth, count, pixels);
            CAPTURE(static_cast<int>(kind), count, moments.mean(), moments.standard_error());
            CHECK(std::abs(moments.mean() - smooth_integral()) < 4.0 * moments.standard_error());
            CHECK(4.0 * moments.standard_error() < 0.01 * smooth_integral());
            const Moments circle = estimates(kind, inside_circle, count, pixels);
            CHECK(std::abs(circle.mean() - 0.25 * 3.14159265) < 4.0 * circle.standard_error());
        }
    }
}

TEST_CASE("the error falls as it should with the number of points", "[sampler]")
{
    // Variance of smooth integrands: n^-3 for Owen's scrambling [1997, "Scrambled Net Variance for
    // Integrals of Smooth Functions"], up to logarithms, 1/n for independent points.
    const auto slope = [](SamplerKind kind, Integrand f) {
        const double few = estimates(kind, f, 8, 1000).variance();
        const double many = estimates(kind, f, 256, 1000).variance();
        return std::log2(many / few) / 5.0;
    };
    CHECK(slope(SamplerKind::sobol, smooth) < -2.6);
    CHECK(slope(SamplerKind::sobol, inside_circle) < -1.3);
    CHECK(slope(SamplerKind::independent, smooth) == Approx(-1.0).margin(0.1));
    CHECK(slope(SamplerKind::independent, inside_circle) == Approx(-1.0).margin(0.1));
    // And what it comes to, at counts that are no powers of two as well.
    for (const std::int64_t count : {2, 3, 8, 12, 100}) {
        CHECK(estimates(SamplerKind::sobol, smooth, count, 1000).variance() <
              0.8 * estimates(SamplerKind::independent, smooth, count, 1000).variance());
    }
}

TEST_CASE("the halves of the film tell the error of their mean", "[sampler]")
{
    for (const auto kind : {SamplerKind::sobol, SamplerKind::independent}) {
        for (const std::int64_t count : {1, 4, 8}) {
            for (const Integrand f : {smooth, inside_circle}) {
                Moments means;
                Moments claims;
                for (int x = 0; x < 8000; ++x) {
                    const SetKey key{.kind = kind, .seed = 2, .x = x};
                    const double even = estimate(key, f, 0, count);
                    const double odd = estimate(key, f, 1, count);
                    means.add(0.5 * (even + odd));
                    claims.add(0.25 * (even - odd) * (even - odd));
                }
                CAPTURE(static_cast<int>(kind), count, means.variance(), claims.mean());
                CHECK(claims.mean() == Approx(means.variance()).epsilon(0.08));
            }
        }
    }
}

namespace {

/// The points of `count` samples of each pixel of a square, whose first pixel is (x, y).
std::vector<SetNumbers> square_points(SetKey key, int side, std::int64_t count)
{
    const SetKey first = key;
    std::vector<SetNumbers> points;
    for (int i = 0; i < side * side; ++i) {
        key.x = first.x + i % side;
        key.y = first.y + i / side;
        for (std::int64_t index = 0; index < count; ++index) {
            points.push_back(numbers(key, index));
        }
    }
    return points;
}

}  // namespace

TEST_CASE("planned samples are nets in pixels, halves of them, and squares of pixels", "[sampler]")
{
    const auto check_net = [](const std::vector<SetNumbers>& points) {
        const int m = std::countr_zero(points.size());
        CHECK(is_net(points, 0, 1, 0));
        CHECK(is_net(points, 1, 2, std::min(m, 1)));
        CHECK(is_net(points, 2, 2, m));
        CHECK(is_net(points, 3, 3, m));
    };
    for (const int k : {0, 1, 4, 5, 8}) {
        const std::int64_t count = std::int64_t{1} << k;
        for (const std::uint32_t vertex : {2U, 7U}) {
            const SetKey key{.x = 64, .y = 128, .vertex = vertex, .log_samples = k};
            for (const int x : {64, 67}) {
                SetKey pixel = key;
                pixel.x = x;
                CAPTURE(k, vertex, x);
                check_net(square_points(pixel, 1, count));
                for (const std::int64_t half : {0, 1}) {
                    if (k > 0) {
                        check_net(half_points(pixel, half, 0, count / 2));
                    }
                }
            }
            CAPTURE(k, vertex);
            check_net(square_points(key, 2, count));
            check_net(square_points(key, 8, count));
        }
    }
    // Neighbours in two squares of the order, or with unknown numbers, know nothing of each other.
    CHECK_FALSE(is_net(square_points({.x = 65, .y = 128, .log_samples = 4}, 2, 16), 0, 1, 0));
    CHECK_FALSE(is_net(square_points({.x = 64, .y = 128}, 2, 16), 0, 1, 0));
}

TEST_CASE("sets of planned samples are not related, and neither are squares of pixels", "[sampler]")
{
    using Keys = std::pair<SetKey, SetKey>;
    constexpr int k = 7;
    constexpr int square = 1 << ((16 - k) / 2);
    constexpr double unrelated = 2.8;
    const auto key = [](int square_x, std::uint32_t vertex) {
        return SetKey{.x = square_x * square, .vertex = vertex, .log_samples = k};
    };
    const auto relation = [&](const SetKey& other) {
        return dependence(
            [&](int x) {
                SetKey moved = other;
                moved.x += x * square;
                return Keys{key(x, 2), moved};
            },
            0, 0, 0, 0);
    };
    CHECK(relation(key(0, 2)) == Approx(64.0));
    CHECK(relation(key(0, 3)) < unrelated);
    CHECK(relation(key(1, 2)) < unrelated);
    CHECK(relation({.y = square, .vertex = 2, .log_samples = k}) < unrelated);
    CHECK(relation({.vertex = 2, .log_samples = k + 1}) < unrelated);
    CHECK(relation({.vertex = 2}) < unrelated);
    // Samples beyond those that were planned are of other sequences.
    for (std::int64_t index = 0; index < 32; ++index) {
        CHECK(numbers({.log_samples = 4}, index) != numbers({.log_samples = 4}, index + 16));
    }
}

TEST_CASE("the first of the planned samples differ between pixels, in every set", "[sampler]")
{
    constexpr int side = 32;
    for (const std::int64_t index : {0, 1, 6}) {
        std::vector<double> in_order(16);
        std::vector<double> shuffled(16);
        for (int i = 0; i < side * side; ++i) {
            const Sampler sampler(SamplerKind::sobol, 7, i % side, i / side, index, 6);
            const float u = sampler.ordered_1d(SampleUse::ground, 4);
            ++in_order[static_cast<std::size_t>(u * 16.0f)];
            const SetNumbers set =
                numbers({.seed = 7, .x = i % side, .y = i / side, .log_samples = 6}, index);
            ++shuffled[static_cast<std::size_t>(set[0] * 16.0f)];
        }
        const std::vector<double> even(16, 1.0 / 16);
        CAPTURE(index);
        CHECK(test::chi_square(in_order, even).p_value > 1e-4);
        CHECK(test::chi_square(shuffled, even).p_value > 1e-4);
    }
}

TEST_CASE("the mean of planned samples is right, and better than that of two sequences",
          "[sampler]")
{
    constexpr int pixels = 20000;
    const auto means_of = [](int k, int log_samples, Integrand f) {
        Moments moments;
        for (int i = 0; i < pixels; ++i) {
            double sum = 0.0;
            for (std::int64_t index = 0; index < std::int64_t{1} << k; ++index) {
                // Far apart, so that their errors are independent.
                const auto u = numbers({.seed = 3,
                                        .x = 256 * (i % 200),
                                        .y = 256 * (i / 200),
                                        .log_samples = log_samples},
                                       index);
                sum += f({u[0], u[1]});
            }
            moments.add(sum / static_cast<double>(std::int64_t{1} << k));
        }
        return moments;
    };
    for (const int k : {0, 2, 4}) {
        const Moments planned = means_of(k, k, smooth);
        CAPTURE(k, planned.mean(), planned.standard_error());
        CHECK(std::abs(planned.mean() - smooth_integral()) < 4.0 * planned.standard_error());
        if (k > 0) {
            CHECK(planned.variance() < 0.8 * means_of(k, Sampler::open_ended, smooth).variance());
        }
    }
    const Moments circle = means_of(4, 4, inside_circle);
    CHECK(std::abs(circle.mean() - 0.25 * 3.14159265) < 4.0 * circle.standard_error());
}

TEST_CASE("errors of neighbouring pixels cancel out after the planned samples", "[sampler]")
{
    // Means of 4 x 4 pixels: 16 times less variance if pixels are independent.
    const auto variance = [](int log_samples, int side) {
        Moments moments;
        for (int i = 0; i < 400; ++i) {
            double sum = 0.0;
            const auto points = square_points(
                {.seed = 4, .x = 256 * (i % 20), .y = 256 * (i / 20), .log_samples = log_samples},
                side, 16);
            for (const SetNumbers& u : points) {
                sum += inside_circle({u[0], u[1]});
            }
            moments.add(sum / static_cast<double>(points.size()));
        }
        return moments.variance();
    };
    CHECK(variance(4, 4) < variance(4, 1) / 32.0);
    CHECK(variance(Sampler::open_ended, 4) > variance(Sampler::open_ended, 1) / 24.0);
}

}  // namespace bdpt::sampler_distribution_test
