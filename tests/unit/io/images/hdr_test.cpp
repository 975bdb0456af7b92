#include "../gltf_fixture.h"
#include "catch.hpp"
#include "encoders.h"
#include "hdr_encoder.h"
#include "image/linear/image_readers.h"

#include <cmath>
#include <utility>

namespace bdpt::test::hdr_test {
using namespace bdpt::io;

namespace {

constexpr auto encodings = {HdrEncoding::flat, HdrEncoding::older, HdrEncoding::newer};

Image read(const std::string& file)
{
    Warnings warnings;
    Image image = read_hdr(view(file), {}, warnings);
    CHECK(warnings.lines().empty());
    return image;
}

struct Read {
    Image image;
    std::vector<std::string> warnings;
};

/// One pixel of (128, 64, 32) times 2^-7, with these lines in the header.
Read read_exposed(const std::string& lines)
{
    HdrFile file = upright(1, 1, {{128, 64, 32, 129}}, HdrEncoding::flat);
    file.lines = lines;
    const std::string bytes = file.bytes();
    Warnings warnings;
    Image image = read_hdr(view(bytes), {}, warnings);
    return {.image = std::move(image), .warnings = warnings.lines()};
}

}  // namespace

TEST_CASE("pixels of Radiance HDR images are mantissas times a power of two, to the bit")
{
    std::vector<Rgbe> pixels;
    for (int exponent = 0; exponent < 256; ++exponent) {
        for (const int mantissa : {0, 1, 77, 128, 255}) {
            pixels.push_back(
                {255, static_cast<std::uint8_t>(mantissa), 2, static_cast<std::uint8_t>(exponent)});
        }
    }
    const Image image = read(upright(5, 256, pixels, HdrEncoding::flat).bytes());
    REQUIRE(image.pixels.size() == pixels.size());
    for (std::size_t i = 0; i < pixels.size(); ++i) {
        const int exponent = pixels[i][3];
        for (int c = 0; c < 3; ++c) {
            const float value =
                exponent == 0
                    ? 0.0f
                    : std::ldexp(static_cast<float>(pixels[i][static_cast<std::size_t>(c)]),
                                 exponent - 136);
            REQUIRE(image.pixels[i][c] == value);
        }
    }
}

TEST_CASE("the encodings of Radiance HDR images say the same")
{
    // Shorter lines than 8 pixels are never in the newer one; long runs have two digits or three.
    for (const auto& [width, height] : {std::pair{8, 3}, {127, 4}, {128, 5}, {1000, 3}, {9, 40}}) {
        const auto count = static_cast<std::size_t>(width * height);
        const std::vector<Rgbe> pixels = make_pixels(count, 700);
        const Image flat = read(upright(width, height, pixels, HdrEncoding::flat).bytes());
        for (const HdrEncoding encoding : encodings) {
            CAPTURE(width, static_cast<int>(encoding));
            CHECK(read(upright(width, height, pixels, encoding).bytes()).pixels == flat.pixels);
        }
    }
    const std::vector<Rgbe> even(16384, {10, 200, 30, 140});
    const std::string packed = upright(16384, 1, even, HdrEncoding::older).bytes();
    CHECK(packed.size() < 100);
    CHECK(read(packed).pixels == std::vector<Rgb>(16384, Rgb(160, 3200, 480)));
}

TEST_CASE("scanlines of one Radiance HDR image may have different encodings")
{
    const std::vector<Rgbe> pixels = make_pixels(60, 20);
    const std::string flat = upright(20, 3, pixels, HdrEncoding::flat).bytes();
    std::string mixed = flat.substr(0, flat.size() - 240);
    auto from = pixels.begin();
    for (const HdrEncoding encoding : encodings) {
        mixed += encode_scanline({from, from + 20}, encoding);
        from += 20;
    }
    CHECK(read(mixed).pixels == read(flat).pixels);
}

TEST_CASE("pixels of Radiance HDR are not taken for the mark of an encoding")
{
    std::vector<Rgbe> pixels(7, {9, 130, 9, 136});
    pixels[0] = {2, 2, 0, 7};
    CHECK(read(upright(7, 1, pixels, HdrEncoding::flat).bytes()).at(0, 0).r ==
          std::ldexp(2.0f, 7 - 136));
    // The third byte of a mark is less than 128.
    std::vector<Rgbe> blue(8, {2, 2, 130, 136});
    CHECK(read(upright(8, 1, blue, HdrEncoding::flat).bytes()).pixels ==
          std::vector<Rgb>(8, Rgb(2, 2, 130)));
    std::vector<Rgbe> many(32768, {9, 130, 9, 136});
    many[0] = {2, 2, 127, 136};
    const std::string file = upright(32768, 1, many, HdrEncoding::flat).bytes();
    ReadLimits limits;
    limits.image_side = 32768;
    Warnings warnings;
    CHECK(read_hdr(view(file), limits, warnings).at(0, 0) == Rgb(2, 2, 127));
    many.pop_back();
    many[0] = many[1];
    const std::string newer = upright(32767, 1, many, HdrEncoding::newer).bytes();
    CHECK(read_hdr(view(newer), limits, warnings).at(32766, 0) == Rgb(9, 130, 9));
}

TEST_CASE("Radiance HDR images are turned upright")
{
    // As they are seen: 1 2 3 in the upper row, 4 5 6 in the lower one.
    struct Turned {
        std::string resolution;
        std::vector<int> order;
    };
    const std::vector<Turned> all{
        {"-Y 2 +X 3", {1, 2, 3, 4, 5, 6}}, {"-Y 2 -X 3", {3, 2, 1, 6, 5, 4}},
        {"+Y 2 +X 3", {4, 5, 6, 1, 2, 3}}, {"+Y 2 -X 3", {6, 5, 4, 3, 2, 1}},
        {"+X 3 -Y 2", {1, 4, 2, 5, 3, 6}}, {"+X 3 +Y 2", {4, 1, 5, 2, 6, 3}},
        {"-X 3 -Y 2", {3, 6, 2, 5, 1, 4}}, {"-X 3 +Y 2", {6, 3, 5, 2, 4, 1}}};
    for (const Turned& turned : all) {
        CAPTURE(turned.resolution);
        HdrFile file{.resolution = turned.resolution,
                     .inner = turned.resolution[1] == 'Y' ? 3U : 2U};
        for (const int value : turned.order) {
            file.pixels.push_back({0, static_cast<std::uint8_t>(value), 128, 136});
        }
        const Image image = read(file.bytes());
        REQUIRE(image.width == 3);
        REQUIRE(image.height == 2);
        for (int i = 0; i < 6; ++i) {
            CHECK(image.at(i % 3, i / 3).g == static_cast<float>(i + 1));
        }
    }
}

TEST_CASE("the exposure of a Radiance HDR image is divided out, with a warning")
{
    const Read exposed = read_exposed("EXPOSURE=4\nSOFTWARE=x\nEXPOSURE= 5.0e-1 \n");
    CHECK(exposed.image.at(0, 0) == Rgb(0.5f, 0.25f, 0.125f));
    REQUIRE(exposed.warnings.size() == 1);
    CHECK(contains(exposed.warnings[0], "exposure 2: divided out"));
    const Read corrected = read_exposed("COLORCORR=1 2 4\nEXPOSURE=0.25\n");
    CHECK(corrected.image.at(0, 0) == Rgb(4.0f, 1.0f, 0.25f));
    REQUIRE(corrected.warnings.size() == 1);
    CHECK(contains(corrected.warnings[0], "exposures 0.25, 0.5, 1: divided out"));
}

TEST_CASE("lines that change no pixel of a Radiance HDR image do not count")
{
    const Read plain = read_exposed("");
    CHECK(plain.image.at(0, 0) == Rgb(1.0f, 0.5f, 0.25f));
    // Lines behind a tab are the header of a picture that this one was made of.
    for (const char* lines :
         {"EXPOSURE=1.0000000000000\n", "EXPOSURE=2\nEXPOSURE=0.5\n", "\tEXPOSURE=2\n",
          "GAMMA=2.2\n", "PRIMARIES=0 0 0 0 0 0 0 0\n", "# EXPOSURE=2\n", "VIEW= -vtv\n"}) {
        CAPTURE(lines);
        const Read same = read_exposed(lines);
        CHECK(same.image.pixels == plain.image.pixels);
        CHECK(same.warnings.empty());
    }
    std::string other = upright(1, 1, {{128, 64, 32, 129}}, HdrEncoding::flat).bytes();
    other.replace(0, 10, "#?RGBE");
    CHECK(is_hdr(view(other)));
    CHECK_FALSE(is_hdr(view(other.substr(0, 5))));
    CHECK(read(other).pixels == plain.image.pixels);
    CHECK(read(other + "more").pixels == plain.image.pixels);
}

}  // namespace bdpt::test::hdr_test
