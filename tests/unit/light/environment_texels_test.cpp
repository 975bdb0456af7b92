#include "light/environment/environment_texels.h"

#include "catch.hpp"
#include "geometry/flush_denormals.h"
#include "light/environment/cell_tables.h"
#include "light/environment_light.h"
#include "math/rgb.h"
#include "statistics.h"

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace bdpt::environment_texels_test {
namespace {

/// Of so many greys in one row.
Image greys(const std::vector<float>& values)
{
    Image image{.width = static_cast<int>(values.size()), .height = 1, .pixels = {}};
    for (const float value : values) {
        image.pixels.emplace_back(value, 0.5f * value, 0.25f * value);
    }
    return image;
}

/// Like a photograph with its sun: many stops, all channels different.
Image wide_image(int width, int height, float sun)
{
    test::Random random(12);
    Image image{.width = width, .height = height, .pixels = {}};
    for (int i = 0; i < width * height; ++i) {
        const float brightness = std::exp2(6.0f * random.next() - 4.0f);
        image.pixels.emplace_back(brightness * random.next(), brightness * random.next(),
                                  brightness * random.next());
    }
    image.pixels[image.pixels.size() / 3] = Rgb(sun, 0.8f * sun, 0.6f * sun);
    return image;
}

}  // namespace

TEST_CASE("environment texels: halves come out as they went in", "[light][texels]")
{
    std::vector<float> all;
    for (std::uint32_t half = 0; half < 0x7c00; ++half) {
        all.push_back(glm::unpackHalf1x16(static_cast<std::uint16_t>(half)));
    }
    Image image{.width = static_cast<int>(all.size()), .height = 1, .pixels = {}};
    for (const float value : all) {
        image.pixels.emplace_back(value, 65504.0f - value > 0.0f ? value : 0.0f, value);
    }
    const EnvironmentTexels texels(image);
    REQUIRE(texels.are_halves());
    const FlushDenormals flush;  // as threads that render do
    for (std::size_t i = 0; i < all.size(); ++i) {
        CAPTURE(i);
        REQUIRE(texels(static_cast<int>(i), 0) == image.pixels[i]);
    }
}

TEST_CASE("environment texels: Radiance's shared exponents come out as they went in",
          "[light][texels]")
{
    std::vector<float> values;
    for (int exponent = -8; exponent < 14; ++exponent) {
        for (int mantissa = 128; mantissa < 256; ++mantissa) {
            values.push_back(std::ldexp(static_cast<float>(mantissa), exponent - 8));
        }
    }
    const Image image = greys(values);
    const EnvironmentTexels texels(image);
    REQUIRE(texels.are_halves());
    for (std::size_t i = 0; i < values.size(); ++i) {
        REQUIRE(texels(static_cast<int>(i), 0) == image.pixels[i]);
    }
}

TEST_CASE("environment texels: floats are rounded by at most 1/2048", "[light][texels]")
{
    for (const float unit : {1e-30f, 1e-6f, 1.0f, 7.3e4f, 1e30f}) {
        Image image = wide_image(64, 32, 3000.0f);
        for (Rgb& pixel : image.pixels) {
            pixel *= unit;
        }
        const EnvironmentTexels texels(image);
        CAPTURE(unit);
        CHECK(texels.are_halves());
        CHECK(texels.bytes() == std::size_t{64} * 32 * 6);
        double before = 0.0;
        double after = 0.0;
        for (int y = 0; y < 32; ++y) {
            for (int x = 0; x < 64; ++x) {
                for (int c = 0; c < 3; ++c) {
                    const float value = image.at(x, y)[c];
                    const float found = texels(x, y)[c];
                    REQUIRE(std::abs(found - value) <= std::max(0x1p-11f * value, 1e-4f * unit));
                    before += static_cast<double>(value);
                    after += static_cast<double>(found);
                }
            }
        }
        CHECK(after == Approx(before).epsilon(0x1p-11));
    }
}

TEST_CASE("environment texels: a range that halves do not have stays as it is", "[light][texels]")
{
    Image image = wide_image(64, 32, 1e30f);
    const EnvironmentTexels texels(image);
    CHECK_FALSE(texels.are_halves());
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 64; ++x) {
            REQUIRE(texels(x, y) == image.at(x, y));
        }
    }
    // A sun of 2e9 nit, as of physical skies, beside 1000 nit is none of these.
    image = wide_image(64, 32, 2e6f);
    CHECK(EnvironmentTexels(image).are_halves());
}

TEST_CASE("environment texels: one texel, none that shines, the greatest float", "[light][texels]")
{
    for (const float value : {0.0f, 1e-45f, 1e-38f, 0.3f, 1e30f, 3e38f}) {
        CAPTURE(value);
        const EnvironmentLight light(
            {.radiance = Image{.width = 1, .height = 1, .pixels = {Rgb(value)}}},
            {.center = Vec3(0.0f), .radius = 1.0f});
        CHECK(light.radiance(Vec3(0, 1, 0)).r == Approx(value).epsilon(0x1p-11).margin(1e-38));
        for (const auto sampling : {EnvironmentSampling::plain, EnvironmentSampling::compensated}) {
            const auto incident =
                light.sample_incident({.normal = Vec3(0, 1, 0)}, Vec2(0.4f, 0.3f), sampling, 0.0f);
            const bool shines = value >= std::numeric_limits<float>::min();
            REQUIRE(incident.has_value() == shines);
            if (shines) {
                CHECK(std::isfinite(incident->pdf.value));
                CHECK(incident->pdf.value > 0.0f);
            }
        }
    }
}

TEST_CASE("environment weights: cells of several texels share out all weight", "[light][texels]")
{
    struct Size {
        int width;
        int height;
        int columns;
        int rows;
    };
    for (const Size size : {Size{4096, 2, 2048, 2}, Size{4100, 3, 1367, 3}, Size{8, 1030, 8, 515},
                            Size{2048, 1, 2048, 1}, Size{6001, 2, 2001, 2}, Size{5, 3, 5, 3}}) {
        CAPTURE(size.width, size.height);
        const Image image = wide_image(size.width, size.height, 100.0f);
        const EnvironmentTexels texels(image);
        std::vector<float> shares;
        double expected = 0.0;
        for (int y = 0; y < size.height; ++y) {
            shares.push_back(0.1f + static_cast<float>(y % 7));
            const auto share = static_cast<double>(shares.back());
            for (int x = 0; x < size.width; ++x) {
                double sum = 3.0 * static_cast<double>(luminance(texels(x, y)));
                for (int dy = -1; dy <= 1; ++dy) {
                    for (int dx = -1; dx <= 1; ++dx) {
                        sum += static_cast<double>(
                            luminance(texels((x + dx + size.width) % size.width,
                                             std::clamp(y + dy, 0, size.height - 1))));
                    }
                }
                expected += sum * share;
            }
        }
        CellWeights weights(texels, shares);
        REQUIRE(weights.columns() == size.columns);
        REQUIRE(weights.rows() == size.rows);
        std::vector<float> row(static_cast<std::size_t>(size.columns));
        double found = 0.0;
        for (int y = 0; y < size.rows; ++y) {
            weights.of_row(y, row);
            for (const float weight : row) {
                REQUIRE(weight > 0.0f);
                found += static_cast<double>(weight);
            }
        }
        CHECK(found * static_cast<double>(texels.greatest()) == Approx(expected).epsilon(1e-5));
    }
}

}  // namespace bdpt::environment_texels_test
