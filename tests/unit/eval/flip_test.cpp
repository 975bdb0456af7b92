#include <bdpt/eval/metric.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "catch.hpp"
#include "test_images.h"

namespace bdpt::eval::flip_test {
namespace {

using test::flat;
using test::random_image;
using test::scaled;

constexpr int width = 48;
constexpr int height = 32;

Image patterns()
{
    Image image{width, height, {}};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            image.pixels.emplace_back(static_cast<float>((x * 7 + y * 13) % 32) / 31.0f,
                                      static_cast<float>((x * 3 + y * 5) % 16) / 15.0f,
                                      static_cast<float>((x / 8 + y / 8) % 2) * 0.75f);
        }
    }
    return image;
}

/// The patterns with a square, a line, a point and a half that are wrong.
Image wrong_patterns()
{
    Image image = patterns();
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            Rgb& pixel = image.pixels[static_cast<std::size_t>(y * width + x)];
            if (x >= 8 && x < 16 && y >= 8 && y < 16) {
                pixel.r = 0.5f;
            }
            if (y == 20) {
                pixel.g = 1.0f;
            }
            if (x == 40 && y == 28) {
                pixel = Rgb(1.0f, 0.0f, 1.0f);
            }
            pixel.b *= x >= width / 2 ? 0.8f : 1.0f;
        }
    }
    return image;
}

/// High dynamic range: up to 64.
Image bright(const Image& image)
{
    Image result = scaled(image, 8.0f);
    for (Rgb& pixel : result.pixels) {
        pixel *= pixel;
    }
    return result;
}

/// The mean, and pixels in the square, at its corner, on the line, of the point, of none, of the
/// half.
void check_map(const ErrorMap& map, double expected_mean, const std::array<double, 6>& expected)
{
    constexpr std::array<std::array<int, 2>, 6> places{
        {{12, 12}, {8, 8}, {30, 20}, {40, 28}, {0, 0}, {26, 4}}};
    CHECK(std::abs(mean(map) - expected_mean) < 2e-5);
    for (std::size_t i = 0; i < places.size(); ++i) {
        CAPTURE(i, map.at(places[i][0], places[i][1]), expected[i]);
        CHECK(std::abs(map.at(places[i][0], places[i][1]) - expected[i]) < 2e-4);
    }
}

// The numbers are those of the authors' own program, version 1.7 of the Python package
// flip-evaluator, for the same pixels.
TEST_CASE("FLIP has the values of the authors' program")
{
    check_map(flip(wrong_patterns(), patterns()), 0.1975823,
              {0.0785976, 0.2132433, 0.5956084, 0.3194381, 0.0000571, 0.2791253});
    check_map(flip(wrong_patterns(), patterns(), 20.0), 0.1577109,
              {0.1077108, 0.9609553, 0.5593813, 0.9605859, 0.0, 0.2938945});
}

TEST_CASE("HDR-FLIP has the values of the authors' program")
{
    const Image reference = bright(patterns());
    const Image image = bright(wrong_patterns());
    const FlipExposures exposures = flip_exposures(reference);
    CHECK(exposures.start == Approx(-4.8703966).epsilon(1e-6));
    CHECK(exposures.stop == Approx(-3.0425351).epsilon(1e-6));
    CHECK(exposures.count == 2);
    check_map(hdr_flip(image, reference, exposures), 0.1913268,
              {0.3248357, 0.3147418, 0.5449916, 0.3576881, 0.0001110, 0.2555483});
    check_map(hdr_flip(image, reference, {.start = -3.0, .stop = 1.0, .count = 3}), 0.1235160,
              {0.3260028, 0.3148384, 0.4149056, 0.4158552, 0.0001063, 0.1172606});
}

TEST_CASE("black and white are as far apart as FLIP can tell, green and blue the farthest colours")
{
    const auto of_flat = [](Rgb a, Rgb b) { return flip(flat(8, 8, a), flat(8, 8, b)).at(4, 4); };
    // Without features the difference of colours is all: of green and blue exactly 1.
    CHECK(of_flat(Rgb(0, 1, 0), Rgb(0, 0, 1)) == Approx(1.0).epsilon(1e-5));
    // HyAB of white and black is 100, raised to 0.7; with the greatest being 41.2760 it lies above
    // the knee at 0.4 of that: 0.95 + 0.05 (25.1189 - 16.5104) / 24.7656.
    CHECK(of_flat(Rgb(1.0f), Rgb(0.0f)) == Approx(0.967380).epsilon(1e-4));
    CHECK(of_flat(Rgb(0.5f), Rgb(0.5f)) == 0.0);
}

TEST_CASE("FLIP is from 0 to 1, symmetrical, and 0 for equal images only")
{
    const Image a = random_image(24, 20, 1);
    const Image b = random_image(24, 20, 2);
    const ErrorMap ab = flip(a, b);
    const ErrorMap ba = flip(b, a);
    const ErrorMap aa = flip(a, a);
    for (std::size_t i = 0; i < ab.values.size(); ++i) {
        REQUIRE(ab.values[i] > 0.0);
        REQUIRE(ab.values[i] <= 1.0);
        REQUIRE(ba.values[i] == ab.values[i]);
        REQUIRE(aa.values[i] == 0.0);
    }
}

TEST_CASE("what is beyond a screen is clamped")
{
    const Image inside = flat(4, 4, Rgb(1.0f, 0.0f, 1.0f));
    CHECK(mean(flip(flat(4, 4, Rgb(7.0f, -3.0f, 1.0f)), inside)) == 0.0);
}

TEST_CASE("exposures go from the brightest to the median luminance")
{
    // The tone curve reaches 0.85 at 2.118871: the positive root of
    // (2.51 - 0.85 2.43) x^2 + (0.03 - 0.85 0.59) x - 0.85 0.14 = 0, divided by 0.6.
    const double bright_end = std::log2(2.118871);
    Image image{5, 1, {Rgb(1), Rgb(24), Rgb(2), Rgb(0.5f), Rgb(0.25f)}};
    FlipExposures exposures = flip_exposures(image);  // median 1, greatest 24
    CHECK(exposures.start == Approx(bright_end - std::log2(24.0)).epsilon(1e-5));
    CHECK(exposures.stop == Approx(bright_end).epsilon(1e-5));
    CHECK(exposures.count == 5);  // log2(24) is 4.6
    CHECK(exposures.at(0) == exposures.start);
    CHECK(exposures.at(1) == Approx(exposures.start + std::log2(24.0) / 4));
    CHECK(exposures.at(4) == Approx(exposures.stop));

    image.pixels = {Rgb(0), Rgb(0), Rgb(0), Rgb(4), Rgb(1)};  // the median is black
    exposures = flip_exposures(image);
    CHECK(exposures.stop == Approx(bright_end + 23).epsilon(1e-5));
    CHECK(exposures.count == 25);

    exposures = flip_exposures(flat(3, 3, Rgb(2.0f)));
    CHECK(exposures.start == exposures.stop);
    CHECK(exposures.count == 2);
    CHECK(flip_exposures(flat(3, 3, Rgb(0.0f))).count == 1);
}

TEST_CASE("extreme pixels give finite errors")
{
    for (const float most : {1e-38f, 1e-44f, 1e30f, 3e38f}) {
        CAPTURE(most);
        const Image reference = random_image(8, 8, 1, most);
        const ErrorMap map =
            hdr_flip(random_image(8, 8, 2, most), reference, flip_exposures(reference));
        CHECK(std::all_of(map.values.begin(), map.values.end(),
                          [](double value) { return value >= 0.0 && value <= 1.0; }));
    }
    const double least = mean(flip(flat(1, 1, Rgb(1.0f)), flat(1, 1, Rgb(0.0f)), 1.0));
    CHECK(least == Approx(mean(flip(flat(1, 1, Rgb(1.0f)), flat(1, 1, Rgb(0.0f)), 1000.0))));
}

}  // namespace
}  // namespace bdpt::eval::flip_test
