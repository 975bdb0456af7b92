#include "light/environment/environment_tiles.h"

#include "catch.hpp"
#include "chi_square.h"
#include "light/environment_light.h"
#include "math/elementary.h"
#include "math/rgb.h"
#include "statistics.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace bdpt::environment_tiles_test {
namespace {

using Normal = std::optional<Vec3>;

struct Size {
    int width;
    int height;
};

constexpr std::array<Size, 9> sizes{
    {{1, 1}, {2, 1}, {1, 9}, {7, 3}, {2, 32}, {33, 2}, {17, 9}, {16, 8}, {128, 64}}};

/// Of all sizes: some texels without weight, and one that has a great share of all.
std::vector<float> weights_with_sun(Size size, std::uint64_t seed)
{
    test::Random random(seed);
    std::vector<float> weights;
    for (int i = 0; i < size.width * size.height; ++i) {
        weights.push_back(random.next() < 0.2f ? 0.0f : random.next());
    }
    weights[weights.size() / 3] = 0.2f * static_cast<float>(weights.size());
    return weights;
}

EnvironmentWeights weights_of(Size size, const std::vector<float>& weights)
{
    return {.width = size.width,
            .height = size.height,
            .of_row = [size, &weights](int y, std::span<float> row) {
                std::copy_n(weights.begin() + std::ptrdiff_t{y} * size.width, row.size(),
                            row.begin());
            }};
}

EnvironmentTiles tiles_of(Size size, const std::vector<float>& weights)
{
    return EnvironmentTiles(weights_of(size, weights));
}

/// Of a point of the image: its left edge is at +z, its top at +y.
Vec3 direction_at(double u, double v)
{
    const double phi = 6.283185307179586 * (u - 0.5);
    const double theta = 3.141592653589793 * v;
    return Vec3(std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi));
}

/// None, those of floor, ceiling and walls, and some askew.
std::vector<Normal> normals()
{
    std::vector<Normal> result{std::nullopt,  Vec3(0, 1, 0), Vec3(0, -1, 0),
                               Vec3(1, 0, 0), Vec3(0, 0, 1), Vec3(0, 0, -1)};
    test::Random random(5);
    for (int i = 0; i < 4; ++i) {
        result.emplace_back(random.direction());
    }
    return result;
}

/// Probabilities of all cells for the normal, by the density.
std::vector<double> probabilities(const EnvironmentTiles& tiles, Size size, const Normal& normal)
{
    std::vector<double> result;
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < tiles.columns(); ++x) {
            result.push_back(static_cast<double>(tiles.pdf(x, y, normal)) /
                             (tiles.columns() * size.height));
        }
    }
    return result;
}

double sum_of(const std::vector<double>& numbers)
{
    double sum = 0.0;
    for (const double number : numbers) {
        sum += number;
    }
    return sum;
}

EnvironmentLight turned_sky()
{
    constexpr Size size{24, 12};
    Image image{.width = size.width, .height = size.height, .pixels = {}};
    test::Random random(8);
    for (int i = 0; i < size.width * size.height; ++i) {
        image.pixels.emplace_back(i == 55 ? 60.0f : random.next());
    }
    return EnvironmentLight(
        {.radiance = std::move(image),
         .world_from_environment = Mat3(glm::rotate(Mat4(1.0f), 2.1f, Vec3(0.6f, 0.0f, 0.8f)))},
        {.center = Vec3(1.0f), .radius = 3.0f});
}

}  // namespace

TEST_CASE("environment tiles: samples have the density that is told", "[light][tiles][long]")
{
    constexpr double significance = 1e-4;
    const std::vector<Normal> all = normals();
    const int tests = static_cast<int>(sizes.size() * all.size());
    int several = 0;
    for (const Size size : sizes) {
        const std::vector<float> weights = weights_with_sun(size, 1);
        const EnvironmentTiles tiles = tiles_of(size, weights);
        for (std::size_t k = 0; k < all.size(); ++k) {
            CAPTURE(size.width, size.height, k);
            const std::vector<double> expected = probabilities(tiles, size, all[k]);
            test::Random random(20 + k);
            if (sum_of(expected) == 0.0) {
                CHECK_FALSE(tiles.sample(random.next_2d(), all[k]).has_value());
                continue;
            }
            CHECK(sum_of(expected) == Approx(1.0).epsilon(1e-5));
            std::vector<double> counts(expected.size(), 0.0);
            for (int i = 0; i < 60000; ++i) {
                const auto sample = tiles.sample(random.next_2d(), all[k]);
                REQUIRE(sample.has_value());
                REQUIRE(sample->pdf == tiles.pdf(sample->column, sample->row, all[k]));
                REQUIRE((sample->offset.x >= 0.0f && sample->offset.x < 1.0f));
                REQUIRE((sample->offset.y >= 0.0f && sample->offset.y < 1.0f));
                counts[static_cast<std::size_t>(sample->row * tiles.columns() + sample->column)] +=
                    1.0;
            }
            const test::ChiSquare result = test::chi_square(counts, expected);
            if (result.degrees >= 1) {
                ++several;
                CHECK(result.p_value > test::sidak(significance, tests));
                if (result.degrees < 1000) {
                    CHECK(result.min_detectable(test::sidak(significance, tests)) < 0.1);
                }
            }
        }
    }
    CHECK(several > 60);
}

TEST_CASE("environment tiles: points are uniform within cells", "[light][tiles]")
{
    constexpr Size size{40, 20};
    const std::vector<float> weights(800, 1.0f);
    const EnvironmentTiles tiles = tiles_of(size, weights);
    const std::vector<double> expected(16, 1.0 / 16.0);
    for (const Normal& normal : {Normal(), Normal(normalize(Vec3(0.3f, 0.7f, -0.4f)))}) {
        std::vector<double> counts(16, 0.0);
        test::Random random(3);
        for (int i = 0; i < 100000; ++i) {
            const Vec2 offset = tiles.sample(random.next_2d(), normal)->offset;
            counts[static_cast<std::size_t>(4.0f * offset.x) +
                   4 * static_cast<std::size_t>(4.0f * offset.y)] += 1.0;
        }
        CHECK(test::chi_square(counts, expected).p_value > 1e-3);
    }
}

TEST_CASE("environment tiles: random numbers keep their order", "[light][tiles]")
{
    constexpr Size size{48, 24};
    const std::vector<float> weights = weights_with_sun(size, 4);
    const EnvironmentTiles tiles = tiles_of(size, weights);
    constexpr int steps = 400;
    for (const Normal& normal : normals()) {
        for (int i = 0; i < 20; ++i) {
            const float other = (static_cast<float>(i) + 0.5f) / 20.0f;
            int row = 0;
            int column = 0;
            for (int k = 0; k < steps; ++k) {
                const float u = (static_cast<float>(k) + 0.5f) / steps;
                const int next_row = tiles.sample({other, u}, normal)->row / 3;
                const int next_column = tiles.sample({u, other}, normal)->column / 3;
                REQUIRE(next_row >= row);
                REQUIRE(next_column >= column);
                row = next_row;
                column = next_column;
            }
        }
    }
}

TEST_CASE("environment tiles: no light above the surface is lost", "[light][tiles]")
{
    // Surfaces that just see a point of a tile.
    test::Random random(6);
    for (const Size size : sizes) {
        const std::vector<float> weights(static_cast<std::size_t>(size.width * size.height), 1.0f);
        const EnvironmentTiles tiles = tiles_of(size, weights);
        for (int i = 0; i < 20000; ++i) {
            const bool at_corner = i % 2 == 0;
            int x = static_cast<int>(random.next() * static_cast<float>(tiles.columns()));
            int y = static_cast<int>(random.next() * static_cast<float>(size.height));
            const double u = (x + (at_corner ? i / 2 % 2 : static_cast<double>(random.next()))) /
                             tiles.columns();
            const double v =
                (y + (at_corner ? i / 4 % 2 : static_cast<double>(random.next()))) / size.height;
            const Vec3 direction = direction_at(u, v);
            const Vec3 across = normalize(cross(direction, random.direction()));
            const float height = std::pow(10.0f, -5.0f * random.next());
            const Vec3 normal = normalize(across + height * direction);
            CAPTURE(size.width, size.height, x, y, height);
            REQUIRE(tiles.pdf(x, y, normal) > 0.0f);
        }
    }
}

TEST_CASE("environment tiles: light that stands high comes first, and none from below",
          "[light][tiles]")
{
    const Size size = GENERATE(Size{128, 64}, Size{1, 32});
    CAPTURE(size.width);
    const std::vector<float> weights(static_cast<std::size_t>(size.width * size.height), 1.0f);
    const EnvironmentTiles tiles = tiles_of(size, weights);
    test::Random random(7);
    for (int i = 0; i < 200; ++i) {
        const Vec3 normal = random.direction();
        double low = 0.0;
        double high = 1e9;
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < tiles.columns(); ++x) {
                const float cosine =
                    dot(normal, direction_at((x + 0.5) / tiles.columns(), (y + 0.5) / size.height));
                const auto pdf = static_cast<double>(tiles.pdf(x, y, normal));
                if (cosine > 0.95f) {
                    high = std::min(high, pdf);
                } else if (cosine > 0.0f && cosine < 0.3f) {
                    low = std::max(low, pdf);
                } else if (cosine < -0.7f) {
                    REQUIRE(pdf == 0.0);
                }
            }
        }
        CHECK(high > 1.2 * low);
    }
}

TEST_CASE("environment tiles: nothing is sampled where nothing can be", "[light][tiles]")
{
    constexpr Size size{64, 32};
    std::vector<float> weights(2048, 0.0f);
    const auto check_empty = [&](const EnvironmentTiles& tiles, const Normal& normal) {
        for (const Vec2 u : {Vec2(0.0f), Vec2(0.3f, 0.8f), Vec2(0x1.fffffep-1f)}) {
            CHECK_FALSE(tiles.sample(u, normal).has_value());
        }
        CHECK(sum_of(probabilities(tiles, size, normal)) == 0.0);
    };
    const EnvironmentTiles black = tiles_of(size, weights);
    check_empty(black, std::nullopt);
    check_empty(black, Vec3(0, 1, 0));
    weights[31 * 64 + 5] = 2.0f;  // at the bottom
    const EnvironmentTiles below = tiles_of(size, weights);
    check_empty(below, Vec3(0, 1, 0));
    CHECK(below.sample({0.4f, 0.6f}, Vec3(0, -1, 0))->row == 31);
    CHECK(below.sample({0.4f, 0.6f}, std::nullopt)->column == 5);
    CHECK(below.pdf(5, 31, Vec3(0, -1, 0)) == Approx(2048.0));
}

TEST_CASE("environment tiles: equal tiles give equal bits", "[light][tiles]")
{
    constexpr Size size{100, 50};
    const std::vector<float> weights = weights_with_sun(size, 9);
    const EnvironmentTiles one = tiles_of(size, weights);
    const EnvironmentTiles other = tiles_of(size, weights);
    const std::vector<Normal> all = normals();
    std::vector<float> found;
    for (const EnvironmentTiles* tiles : {&one, &other, &one}) {
        test::Random random(1);
        for (std::size_t i = 0; i < 3000; ++i) {
            const auto sample = tiles->sample(random.next_2d(), all[i % all.size()]);
            REQUIRE(sample.has_value());
            const float pdf = tiles->pdf(sample->column, sample->row, all[(i + 3) % all.size()]);
            found.insert(found.end(), {sample->offset.x, sample->pdf, pdf});
        }
    }
    const auto third = static_cast<std::ptrdiff_t>(found.size() / 3);
    CHECK(std::equal(found.begin(), found.begin() + third, found.begin() + third));
    CHECK(std::equal(found.begin(), found.begin() + third, found.begin() + 2 * third));
}

TEST_CASE("environment: for a receiver, a density of directions that is that of the samples",
          "[light][tiles]")
{
    const EnvironmentLight light = turned_sky();
    const auto sampling = GENERATE(EnvironmentSampling::plain, EnvironmentSampling::compensated);
    for (const Normal& normal : normals()) {
        const LightSampleContext receiver{.normal = normal};
        test::Random random(11);
        test::Moments density;
        test::Moments irradiance;
        const auto seen = [&](Vec3 w) { return normal ? std::max(0.0f, dot(*normal, w)) : 1.0f; };
        for (int i = 0; i < 200000; ++i) {
            const Vec3 w = random.direction();
            const float pdf = light.pdf_incident(receiver, {.p = w}, sampling).value;
            density.add(static_cast<double>(4.0f * pi * pdf));
            // What is above the surface and never sampled is left to others.
            const bool left_out = sampling == EnvironmentSampling::compensated && pdf == 0.0f;
            irradiance.add(
                left_out ? 0.0
                         : static_cast<double>(4.0f * pi * seen(w) * luminance(light.radiance(w))));
        }
        CHECK(std::abs(density.mean() - 1.0) < 4.5 * density.standard_error());
        CHECK(density.standard_error() < 0.03);
        test::Moments sampled;
        int elsewhere = 0;
        constexpr int samples = 40000;
        for (int i = 0; i < samples; ++i) {
            const auto incident = light.sample_incident(receiver, random.next_2d(), sampling, 0.0f);
            REQUIRE(incident.has_value());
            REQUIRE(incident->pdf.value == incident->pdf_solid_angle.value);
            // Rounding can move a direction into the next texel.
            const float pdf = light.pdf_incident(receiver, {.p = incident->wi}, sampling).value;
            elsewhere += pdf == incident->pdf.value ? 0 : 1;
            sampled.add(static_cast<double>(luminance(light.incident_weight(*incident)) *
                                            seen(incident->wi)));
        }
        CHECK(elsewhere < samples / 1000);
        const double error = std::hypot(sampled.standard_error(), irradiance.standard_error());
        CHECK(std::abs(sampled.mean() - irradiance.mean()) < 4.5 * error);
        CHECK(error < 0.05 * irradiance.mean());
    }
}

}  // namespace bdpt::environment_tiles_test
