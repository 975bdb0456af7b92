#include "film/pixel_filter.h"

#include "catch.hpp"
#include "chi_square.h"
#include "statistics.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace bdpt::pixel_filter_test {
namespace {

const std::vector<FilterOptions> filters{{.kind = FilterKind::box},
                                         {.kind = FilterKind::box, .radius = 0.3f},
                                         {.kind = FilterKind::box, .radius = 1.25f},
                                         {.kind = FilterKind::tent},
                                         {.kind = FilterKind::tent, .radius = 4.0f},
                                         {.kind = FilterKind::gaussian},
                                         {.kind = FilterKind::gaussian, .radius = 2.2f},
                                         {.kind = FilterKind::blackman_harris}};

/// The curves by their definitions, over their integrals from -1 to 1.
double expected_density(const FilterOptions& options, double offset)
{
    using std::numbers::pi;
    const auto radius = static_cast<double>(options.radius.value_or(default_radius(options.kind)));
    const double t = std::abs(offset) / radius;
    if (t >= 1.0) {
        return 0.0;
    }
    switch (options.kind) {
        case FilterKind::box:
            return 0.5 / radius;
        case FilterKind::tent:
            return (1.0 - t) / radius;
        case FilterKind::gaussian: {
            // sigma = radius / 3: the integral of exp(-x^2 / (2 sigma^2)) over [-3, 3] sigma.
            const double integral = std::sqrt(2.0 * pi) / 3.0 * std::erf(3.0 / std::sqrt(2.0));
            const double end = std::exp(-4.5);
            return (std::exp(-4.5 * t * t) - end) / (integral - 2.0 * end) / radius;
        }
        case FilterKind::blackman_harris:
            return (0.35875 + 0.48829 * std::cos(pi * t) + 0.14128 * std::cos(2.0 * pi * t) +
                    0.01168 * std::cos(3.0 * pi * t)) /
                   (2.0 * 0.35875) / radius;
    }
    return 0.0;
}

}  // namespace

TEST_CASE("pixel filters have their definitions' densities", "[filter]")
{
    for (const FilterOptions& options : filters) {
        const PixelFilter filter(options);
        const auto radius = static_cast<double>(filter.radius());
        for (int i = -110; i <= 110; ++i) {
            const double offset = radius * (i + 0.5) / 100.0;
            CAPTURE(static_cast<int>(options.kind), radius, offset);
            CHECK(static_cast<double>(filter.density(static_cast<float>(offset))) ==
                  Approx(expected_density(options, offset)).margin(3e-3 / radius));
        }
    }
}

TEST_CASE("camera samples of a pixel follow its filter", "[filter]")
{
    constexpr std::size_t bins = 12;
    constexpr int samples = 100000;
    std::uint64_t seed = 40;
    for (const FilterOptions& options : filters) {
        const PixelFilter filter(options);
        const float radius = filter.radius();
        test::Random random(++seed);
        std::vector<double> counts(bins * bins);
        std::vector<double> expected(bins * bins);
        for (int i = 0; i < samples; ++i) {
            const Vec2 raster = filter.sample_raster(7, 3, random.next_2d());
            const Vec2 cell =
                (raster - Vec2(7.5f, 3.5f) + radius) / (2.0f * radius) * static_cast<float>(bins);
            REQUIRE(cell.x >= -1e-3f);
            REQUIRE(cell.y <= static_cast<float>(bins) + 1e-3f);
            const auto x = std::min(static_cast<std::size_t>(std::max(cell.x, 0.0f)), bins - 1);
            const auto y = std::min(static_cast<std::size_t>(std::max(cell.y, 0.0f)), bins - 1);
            counts[y * bins + x] += 1.0;
        }
        std::vector<double> factor(bins);
        constexpr int steps = 200;
        const double step = 2.0 * static_cast<double>(radius) / (bins * steps);
        for (std::size_t i = 0; i < bins * steps; ++i) {
            const double offset =
                (static_cast<double>(i) + 0.5) * step - static_cast<double>(radius);
            factor[i / steps] += expected_density(options, offset) * step;
        }
        for (std::size_t i = 0; i < bins * bins; ++i) {
            expected[i] = factor[i / bins] * factor[i % bins];
        }
        const test::ChiSquare result = test::chi_square(counts, expected);
        CAPTURE(static_cast<int>(options.kind), radius, result.statistic, result.degrees);
        CHECK(result.p_value > 1e-4);
        CHECK(result.min_detectable(1e-4) < 0.05);
    }
}

TEST_CASE("a splat counts for each pixel what the pixel's filter says", "[filter]")
{
    // Over all random numbers, weight times chance of a pixel is h(raster - centre).
    constexpr int grid = 1000;
    for (const FilterOptions& options : filters) {
        const PixelFilter filter(options);
        for (const float position : {20.0f, 20.13f, 20.5f, 20.75f, -0.4f}) {
            constexpr int first = -30;
            std::vector<double> found(80);
            for (int i = 0; i < grid; ++i) {
                const float u = (static_cast<float>(i) + 0.5f) / grid;
                const SplatTarget target = filter.choose_pixel({position, 5.5f}, {u, 0.5f});
                const auto pixel = static_cast<std::size_t>(std::floor(target.raster.x) - first);
                found[pixel] += static_cast<double>(target.weight) / grid;
            }
            // The other factor, which is the same in all of them.
            double across = 0.0;
            for (int y = -20; y <= 40; ++y) {
                across +=
                    static_cast<double>(filter.density(5.5f - (static_cast<float>(y) + 0.5f)));
            }
            for (std::size_t i = 0; i < found.size(); ++i) {
                const double center = static_cast<double>(i) + first + 0.5;
                CAPTURE(static_cast<int>(options.kind), filter.radius(), position, center);
                const double offset = static_cast<double>(position) - center;
                const bool edge =
                    std::abs(std::abs(offset) - static_cast<double>(filter.radius())) < 1e-5;
                if (!edge) {
                    CHECK(found[i] ==
                          Approx(expected_density(options, offset) * across).margin(5e-3));
                }
            }
        }
    }
}

TEST_CASE("the default filter is the pixel itself, to the bit", "[filter]")
{
    const PixelFilter filter(FilterOptions{});
    CHECK(filter.radius() == 0.5f);
    test::Random random(5);
    for (int i = 0; i < 100; ++i) {
        const Vec2 u = random.next_2d();
        CHECK(filter.sample_raster(900, 31, u) == Vec2(900.0f, 31.0f) + u);
        const Vec2 raster = 50.0f * u;
        const SplatTarget target = filter.choose_pixel(raster, random.next_2d());
        CHECK(target.raster == raster);
        CHECK(target.weight == 1.0f);
    }
}

TEST_CASE("filters stay finite at the ends of the random numbers", "[filter]")
{
    constexpr float most = 1.0f - 0x1p-24f;
    for (const FilterOptions& options : filters) {
        const PixelFilter filter(options);
        for (const float u : {0.0f, 0x1p-24f, 0.5f, 0.5f - 0x1p-24f, most}) {
            const Vec2 raster = filter.sample_raster(0, 0, Vec2(u));
            CHECK(std::abs(raster.x - 0.5f) <= filter.radius() * 1.001f);
            const SplatTarget target = filter.choose_pixel({0.25f, 0.5f}, Vec2(u));
            CHECK(std::abs(target.raster.x - 0.25f) <= filter.radius() + 0.5f);
            CHECK(std::isfinite(target.weight));
        }
    }
}

}  // namespace bdpt::pixel_filter_test
