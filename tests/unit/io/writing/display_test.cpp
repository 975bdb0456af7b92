#include <bdpt/error.h>
#include <bdpt/io/display.h>
#include <bdpt/io/write_image.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "catch.hpp"
#include "image_files.h"
#include "scratch_folder.h"

namespace bdpt::io::display_test {
namespace {

using test::ScratchFolder;

/// The values of an image of 16 bits.
std::vector<std::uint16_t> words(const TexelImage& image)
{
    std::vector<std::uint16_t> result(image.bytes.size() / 2);
    std::memcpy(result.data(), image.bytes.data(), image.bytes.size());
    return result;
}

/// A pixel that is covered, one that is half covered, and one that is not.
const Image image{3, 1, {Rgb(0.4f, 0.2f, 0.1f), Rgb(0.2f, 0.1f, 0.05f), Rgb(0.0f)}};
const std::vector<float> coverage{1.0f, 0.5f, 0.0f};
constexpr DisplayOptions plain{.curve = ToneCurve::none};

TEST_CASE("alpha is straight: a half covered pixel has the colour of a covered one")
{
    const TexelImage shown = to_display(image, coverage, plain);
    REQUIRE(shown.channels == 4);
    REQUIRE(shown.bytes.size() == 12);
    const std::uint8_t r = encode_srgb(0.4f);
    const std::uint8_t g = encode_srgb(0.2f);
    const std::uint8_t b = encode_srgb(0.1f);
    CHECK(shown.bytes == std::vector<std::uint8_t>{r, g, b, 255, r, g, b, 128, 0, 0, 0, 0});
}

TEST_CASE("a background is exactly its colour where nothing covers it")
{
    for (const TexelType type : {TexelType::unorm8, TexelType::unorm16}) {
        for (int code = 0; code < 256; ++code) {
            const auto value = static_cast<std::uint8_t>(code);
            DisplayOptions options = plain;
            options.curve = ToneCurve::agx;
            options.type = type;
            options.background = SrgbColor{value, 255, 0};
            const TexelImage shown = to_display(image, coverage, options);
            REQUIRE(shown.channels == 3);
            CAPTURE(code);
            if (type == TexelType::unorm8) {
                CHECK(shown.bytes[6] == value);
                CHECK(shown.bytes[7] == 255);
                CHECK(shown.bytes[8] == 0);
            } else {
                CHECK(words(shown)[6] == 257 * code);
                CHECK(words(shown)[7] == 65535);
                CHECK(words(shown)[8] == 0);
            }
        }
    }
}

TEST_CASE("images are composed over a background in light")
{
    DisplayOptions options = plain;
    options.background = SrgbColor{255, 255, 255};
    const TexelImage shown = to_display(image, coverage, options);
    CHECK(shown.bytes[0] == encode_srgb(0.4f));
    CHECK(shown.bytes[3] == encode_srgb(0.5f * 0.4f + 0.5f));
    CHECK(shown.bytes[5] == encode_srgb(0.5f * 0.1f + 0.5f));
}

TEST_CASE("a backplate keeps its codes where nothing covers it, and lies behind in light")
{
    for (int code = 0; code < 256; ++code) {
        const float part = static_cast<float>(code) / 255.0f;
        const float value =
            part <= 0.04045f ? part / 12.92f : std::pow((part + 0.055f) / 1.055f, 2.4f);
        const Image plate{3, 1, {Rgb(0.9f), Rgb(1.0f, 0.0f, 0.5f), Rgb(value, 1.0f, 0.0f)}};
        DisplayOptions options = plain;
        options.exposure = 3.0f;  // of the image alone
        options.backplate = &plate;
        const TexelImage shown = to_display(image, coverage, options);
        REQUIRE(shown.channels == 3);
        CHECK(shown.bytes[6] == code);
        CHECK(shown.bytes[7] == 255);
        CHECK(shown.bytes[3] == encode_srgb(0.5f * 1.0f + 0.5f));
        CHECK(shown.bytes[5] == encode_srgb(0.5f * 0.8f + 0.25f));
    }
    const Image small{2, 1, {Rgb(0.0f), Rgb(0.0f)}};
    DisplayOptions options = plain;
    options.backplate = &small;
    CHECK_THROWS_AS(to_display(image, coverage, options), Error);
}

TEST_CASE("a shadow darkens the backplate")
{
    const Image plate{3, 1, {Rgb(0.5f), Rgb(0.5f), Rgb(0.8f, 0.4f, 0.2f)}};
    const std::vector<float> alpha{1.0f, 0.5f, 0.25f};
    const std::vector<float> shadow{0.0f, 0.0f, 0.25f};
    DisplayOptions options = plain;
    options.shadow = shadow;
    options.backplate = &plate;
    const TexelImage shown = to_display(image, alpha, options);
    CHECK(shown.bytes[6] == encode_srgb(0.75f * 0.8f));
    CHECK(shown.bytes[8] == encode_srgb(0.75f * 0.2f));
}

TEST_CASE("colours are tone-mapped as if they covered all of a pixel")
{
    DisplayOptions options{.exposure = 2.0f, .curve = ToneCurve::pbr_neutral};
    const TexelImage shown = to_display(image, coverage, options);
    CHECK(shown.bytes[4] == encode_srgb(pbr_neutral({1.6f, 0.8f, 0.4f}).r));
    CHECK(shown.bytes[5] == encode_srgb(pbr_neutral({1.6f, 0.8f, 0.4f}).g));
}

TEST_CASE("a shadow is black below the image, and changes none of its colours")
{
    // A half covered pixel whose other half is a quarter in shadow, and a shadow alone.
    const std::vector<float> alpha{1.0f, 0.625f, 0.25f};
    const std::vector<float> shadow{0.0f, 0.125f, 0.25f};
    DisplayOptions options{.exposure = 1.0f, .curve = ToneCurve::filmic, .shadow = shadow};
    const TexelImage shown = to_display(image, alpha, options);
    const Rgb covered = apply(ToneCurve::filmic, {0.8f, 0.4f, 0.2f});
    CHECK(shown.bytes[0] == encode_srgb(covered.r));
    CHECK(shown.bytes[4] == encode_srgb(0.8f * covered.r));
    CHECK(shown.bytes[7] == 159);
    CHECK(std::vector<std::uint8_t>(shown.bytes.begin() + 8, shown.bytes.end()) ==
          std::vector<std::uint8_t>{0, 0, 0, 64});
    options.background = SrgbColor{255, 255, 255};
    const TexelImage composed = to_display(image, alpha, options);
    CHECK(composed.bytes[3] == encode_srgb(0.5f * covered.r + 0.375f));
    CHECK(composed.bytes[6] == encode_srgb(0.75f));

    // Without any it is as if none were given.
    const std::vector<float> none(3, 0.0f);
    options.shadow = none;
    DisplayOptions without = options;
    without.shadow = {};
    CHECK(to_display(image, coverage, options).bytes == to_display(image, coverage, without).bytes);
    options.shadow = std::span(none).first(2);
    CHECK_THROWS_AS(to_display(image, coverage, options), Error);
}

TEST_CASE("16 bits tell apart what 8 bits do not")
{
    const Image close{2, 1, {Rgb(0.5f), Rgb(0.5001f)}};
    DisplayOptions options = plain;
    CHECK(to_display(close, {}, options).bytes[0] == to_display(close, {}, options).bytes[3]);
    options.type = TexelType::unorm16;
    const TexelImage shown = to_display(close, {}, options);
    CHECK(shown.channels == 3);
    // sRGB of 0.5 is 0.735356983, of 0.5001 0.735423706.
    CHECK(words(shown)[0] == 48192);
    CHECK(words(shown)[3] == 48196);
}

TEST_CASE("PNG files hold alpha and 16 bits")
{
    const ScratchFolder folder;
    for (const TexelType type : {TexelType::unorm8, TexelType::unorm16}) {
        for (const bool opaque : {true, false}) {
            DisplayOptions options = plain;
            options.type = type;
            const TexelImage shown =
                to_display(image, opaque ? std::vector<float>() : coverage, options);
            write_png(folder / "a.png", shown, {.metadata = {}, .curve = ToneCurve::none});
            test::PngFile file = test::read_png(folder / "a.png");
            CHECK(file.width == 3);
            CHECK(file.height == 1);
            CHECK(file.channels == (opaque ? 3 : 4));
            CHECK(file.bits == (type == TexelType::unorm8 ? 8 : 16));
            CHECK(file.has_srgb_chunk);
            CHECK(file.text["bdpt.toneMap"] == "none");
            const std::vector<std::uint16_t> expected =
                type == TexelType::unorm16
                    ? words(shown)
                    : std::vector<std::uint16_t>(shown.bytes.begin(), shown.bytes.end());
            CHECK(file.values == expected);
        }
    }
}

TEST_CASE("images that no PNG file can hold are refused")
{
    const ScratchFolder folder;
    const auto refuses = [&](const TexelImage& bad) {
        try {
            write_png(folder / "a.png", bad, {});
        } catch (const Error& error) {
            return error.code() == ErrorCode::usage;
        }
        return false;
    };
    const std::vector<std::uint8_t> bytes(16);
    CHECK(refuses({1, 1, bytes, 4, TexelType::float32}));
    CHECK(refuses({1, 1, bytes, 8, TexelType::unorm16}));
    CHECK(refuses({1, 1, bytes, 0, TexelType::unorm8}));
    CHECK(refuses({2, 2, bytes, 3, TexelType::unorm8}));
    CHECK(refuses({2, 2, bytes, 4, TexelType::unorm16}));
    CHECK_FALSE(refuses({2, 2, bytes, 4, TexelType::unorm8}));
    CHECK_FALSE(refuses({4, 4, bytes, 1, TexelType::unorm8}));
    CHECK_THROWS_AS(to_display(image, std::vector<float>(2), plain), Error);
    DisplayOptions halves = plain;
    halves.type = TexelType::half;
    CHECK_THROWS_AS(to_display(image, {}, halves), Error);
}

}  // namespace
}  // namespace bdpt::io::display_test
