#include <bdpt/io/display.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <vector>

#include "catch.hpp"

namespace bdpt::io::tone_map_test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

/// A smooth image of four decades with a few very bright and some black pixels, as a room with a
/// lamp has them.
Image room(float scale)
{
    Image image{64, 32, {}};
    for (int i = 0; i < 64 * 32; ++i) {
        const float t = static_cast<float>(i) / (64.0f * 32.0f);
        const float value = std::pow(10.0f, -3.0f + 4.0f * t);
        image.pixels.push_back(scale * value * Rgb(1.0f, 0.8f, 0.5f));
    }
    std::fill_n(image.pixels.begin(), 200, Rgb(0.0f));
    std::fill_n(image.pixels.begin() + 300, 8, scale * Rgb(5000.0f));
    return image;
}

Image filled(Rgb value)
{
    return {10, 10, std::vector<Rgb>(100, value)};
}

float luminance_of(Rgb c)
{
    return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
}

TEST_CASE("automatic exposure follows the scale of the image")
{
    const float reference = automatic_exposure(room(1.0f));
    for (const float scale : {1e-4f, 1e-2f, 3.0f, 1e3f, 1e6f}) {
        CAPTURE(scale);
        CHECK(automatic_exposure(room(scale)) == Approx(reference - std::log2(scale)).margin(1e-3));
    }
}

TEST_CASE("a tone-mapped image does not depend on the scale of its pixels")
{
    const Image image = room(1.0f);
    const DisplayImage reference = tone_map(image, automatic_exposure(image));
    for (const float scale : {1e-4f, 7.0f, 1e6f}) {
        const Image scaled = room(scale);
        const DisplayImage result = tone_map(scaled, automatic_exposure(scaled));
        int largest = 0;
        for (std::size_t i = 0; i < result.rgb.size(); ++i) {
            largest = std::max(largest, std::abs(int{result.rgb[i]} - int{reference.rgb[i]}));
        }
        CAPTURE(scale);
        CHECK(largest <= 1);
    }
    // And it is an image: neither white nor black.
    const auto [darkest, brightest] =
        std::minmax_element(reference.rgb.begin(), reference.rgb.end());
    CHECK(*darkest == 0);
    CHECK(*brightest == 255);
}

TEST_CASE("a uniform image is exposed to middle grey")
{
    const float exposure = automatic_exposure(filled(Rgb(20.0f)));
    CHECK(20.0f * std::exp2(exposure) == Approx(0.18f));
}

TEST_CASE("a bright image stays brighter than grey, one with highlights does not get darker")
{
    // A tenth of the image differs from the rest by a factor of 100.
    const auto exposed_rest = [](float tenth) {
        Image image = filled(Rgb(4.0f));
        std::fill_n(image.pixels.begin(), 10, Rgb(4.0f * tenth));
        return 4.0f * std::exp2(automatic_exposure(image));
    };
    const float against_the_sky = exposed_rest(0.01f);
    CHECK(against_the_sky > 0.4f);
    CHECK(against_the_sky < 0.6f);
    const float with_a_lamp = exposed_rest(100.0f);
    CHECK(with_a_lamp > 0.09f);
    CHECK(with_a_lamp < 0.18f);
}

TEST_CASE("pixels that show nothing and a few lamps do not move the exposure")
{
    Image image = room(1.0f);
    const float reference = automatic_exposure(image);

    SECTION("black ones")
    {
        image.height *= 2;
        image.pixels.resize(2 * image.pixels.size(), Rgb(0.0f));
        CHECK(automatic_exposure(image) == Approx(reference));
    }
    SECTION("NaN and infinite ones")
    {
        image.height += 1;
        image.pixels.resize(image.pixels.size() + 32, Rgb(nan));
        image.pixels.resize(image.pixels.size() + 32, Rgb(infinity));
        CHECK(automatic_exposure(image) == Approx(reference));
    }
    SECTION("stray light far below the highlights")
    {
        image.height *= 2;
        image.pixels.resize(2 * image.pixels.size(), Rgb(1e-7f));
        CHECK(automatic_exposure(image) == Approx(reference));
    }
    SECTION("lamps a thousand times brighter")
    {
        for (std::size_t i = 300; i < 308; ++i) {
            image.pixels[i] *= 1000.0f;
        }
        CHECK(automatic_exposure(image) == Approx(reference).margin(0.05));
    }
}

TEST_CASE("images without anything to see have a defined exposure")
{
    CHECK(automatic_exposure(filled(Rgb(0.0f))) == 0.0f);
    CHECK(automatic_exposure(filled(Rgb(nan))) == 0.0f);
    CHECK(automatic_exposure(filled(Rgb(infinity))) == 0.0f);
    CHECK(automatic_exposure(Image{}) == 0.0f);
    const DisplayImage black = tone_map(filled(Rgb(0.0f)), 0.0f);
    CHECK(std::all_of(black.rgb.begin(), black.rgb.end(), [](auto v) { return v == 0; }));
}

TEST_CASE("the filmic curve goes from 0 to 1 and never falls")
{
    CHECK(filmic(Rgb(0.0f)) == Rgb(0.0f));
    CHECK(filmic(Rgb(1e30f)).g == 1.0f);
    for (const Rgb hue : {Rgb(1.0f), Rgb(1.0f, 0.2f, 0.0f), Rgb(0.1f, 0.3f, 1.0f)}) {
        Rgb previous(0.0f);
        for (float stop = -20.0f; stop <= 30.0f; stop += 0.125f) {
            const Rgb value = filmic(std::exp2(stop) * hue);
            CAPTURE(stop, hue.r, hue.g, hue.b);
            for (int channel = 0; channel < 3; ++channel) {
                // Half a step of an 8-bit image's 1/255 is invisible; 1e-6 is rounding.
                CHECK(value[channel] >= previous[channel] - 1e-6f);
                CHECK(value[channel] <= 1.0f);
            }
            previous = value;
        }
    }
    // The published fit at 1: 2.54 / 3.16.
    CHECK(filmic(Rgb(1.0f)).r == Approx(2.54 / 3.16));
}

TEST_CASE("bright colours fade to white, dim ones keep their hue")
{
    const Rgb dim = filmic(Rgb(0.2f, 0.1f, 0.0f));
    CHECK(dim.g / dim.r == Approx(0.5f));
    CHECK(dim.b == 0.0f);
    const Rgb bright = filmic(Rgb(1000.0f, 0.0f, 0.0f));
    CHECK(bright.r == 1.0f);
    CHECK(bright.g > 0.9f);
    CHECK(luminance_of(filmic(Rgb(8.0f, 0.0f, 0.0f))) >
          luminance_of(filmic(Rgb(2.0f, 0.0f, 0.0f))));
}

TEST_CASE("values that are no colours do no harm")
{
    CHECK(filmic(Rgb(nan, -1.0f, 0.0f)) == Rgb(0.0f));
    CHECK(filmic(Rgb(infinity)) == Rgb(1.0f));
    const DisplayImage result = tone_map(Image{1, 1, {Rgb(nan, infinity, -infinity)}}, -20.0f);
    CHECK(result.rgb[1] == 255);
    CHECK(encode_srgb(nan) == 0);
}

TEST_CASE("an exposure step doubles what the curve sees")
{
    const DisplayImage brighter = tone_map(filled(Rgb(0.1f)), 2.0f);
    const DisplayImage reference = tone_map(filled(Rgb(0.4f)), 0.0f);
    CHECK(brighter.rgb == reference.rgb);
}

TEST_CASE("sRGB encoding follows the standard")
{
    CHECK(encode_srgb(0.0f) == 0);
    CHECK(encode_srgb(1.0f) == 255);
    CHECK(encode_srgb(2.0f) == 255);
    CHECK(encode_srgb(-1.0f) == 0);
    CHECK(encode_srgb(0.002f) == 7);      // the linear part: 12.92 * 0.002 * 255 = 6.59
    CHECK(encode_srgb(0.21586f) == 128);  // 128 / 255 in sRGB is 0.21586 in light
}

}  // namespace
}  // namespace bdpt::io::tone_map_test
