#include "catch.hpp"
#include "encoders.h"
#include "image/encoded_image.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstdlib>
#include <stdexcept>

namespace bdpt::test::decoding_test {
using namespace bdpt::io;

namespace {

constexpr auto jpeg_kinds = {JpegKind::baseline, JpegKind::subsampled, JpegKind::progressive,
                             JpegKind::restarts, JpegKind::grey,       JpegKind::rgb};

TexelImage decode(const std::string& file)
{
    const DecodedImage decoded = decode_texels(view(file), {});
    CHECK(decoded.damage.empty());
    CHECK(decoded.image.type == TexelType::unorm8);
    return decoded.image;
}

/// Of values in [0, 255].
double mean_difference(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b)
{
    REQUIRE(a.size() == b.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum += std::abs(int{a[i]} - int{b[i]});
    }
    return sum / static_cast<double>(a.size());
}

}  // namespace

TEST_CASE("JPEG images of all kinds are what was encoded, but for its losses")
{
    for (const JpegKind kind : jpeg_kinds) {
        CAPTURE(static_cast<int>(kind));
        const Picture picture = make_picture(45, 38, channels_of(kind));
        const TexelImage image = decode(encode_jpeg(picture, kind));
        CHECK(image.width == 45);
        CHECK(image.height == 38);
        REQUIRE(image.channels == picture.channels);
        CHECK(mean_difference(image.bytes, picture.values) < 12.0);
    }
}

TEST_CASE("inks of a JPEG image become colours")
{
    // What cyan, magenta, yellow and black leave of the light.
    for (const JpegKind kind : {JpegKind::cmyk, JpegKind::ycck}) {
        Picture inks{.width = 16, .height = 16, .channels = 4};
        for (int i = 0; i < 16 * 16; ++i) {
            inks.values.insert(inks.values.end(), {255, 128, 64, 100});
        }
        const TexelImage image = decode(encode_jpeg(inks, kind));
        REQUIRE(image.channels == 3);
        REQUIRE(image.bytes.size() == 16 * 16 * 3);
        CHECK(std::abs(image.bytes[0] - 100) <= 2);
        CHECK(std::abs(image.bytes[1] - 50) <= 2);
        CHECK(std::abs(image.bytes[2] - 25) <= 2);
    }
}

TEST_CASE("lossless WebP images are what was encoded, also where alpha is 0")
{
    for (const int channels : {3, 4}) {
        const Picture picture = make_picture(45, 38, channels);
        CHECK((channels == 3 || std::count(picture.values.begin(), picture.values.end(), 0) > 5));
        const TexelImage image = decode(encode_webp(picture, true));
        CHECK(image.width == 45);
        CHECK(image.height == 38);
        CHECK(image.channels == channels);
        CHECK(image.bytes == picture.values);
    }
}

TEST_CASE("lossy WebP images are what was encoded, but for their losses, and not for alpha's")
{
    for (const int channels : {3, 4}) {
        const Picture picture = make_picture(46, 38, channels);
        const TexelImage image = decode(encode_webp(picture, false));
        REQUIRE(image.channels == channels);
        CHECK(mean_difference(image.bytes, picture.values) < 20.0);
        for (std::size_t i = 3; channels == 4 && i < image.bytes.size(); i += 4) {
            REQUIRE(image.bytes[i] == picture.values[i]);
        }
    }
}

TEST_CASE("of an animated WebP image the first frame counts, where it lies")
{
    const Picture first = make_picture(5, 3, 4);
    const Picture second = make_picture(12, 8, 4);
    const std::string file =
        animate(12, 8, {encode_webp(first, true), 5, 3}, 4, 2, {encode_webp(second, true), 12, 8});
    const TexelImage image = decode(file);
    CHECK(image.width == 12);
    CHECK(image.height == 8);
    REQUIRE(image.channels == 4);
    for (std::size_t y = 0; y < 8; ++y) {
        for (std::size_t x = 0; x < 12; ++x) {
            const bool is_inside = x >= 4 && x < 9 && y >= 2 && y < 5;
            for (std::size_t c = 0; c < 4; ++c) {
                const int expected = is_inside ? first.values[4 * (5 * (y - 2) + x - 4) + c] : 0;
                REQUIRE(int{image.bytes[4 * (12 * y + x) + c]} == expected);
            }
        }
    }
}

TEST_CASE("images that are decoded at once are as if each were alone, broken ones between them")
{
    std::vector<std::string> files;
    // Those of endless scans are refused after some time, while others are on their way.
    const std::string endless =
        repeat_scan(encode_jpeg(make_picture(64, 64, 3), JpegKind::progressive), 600);
    for (int i = 0; i < 12; ++i) {
        for (const JpegKind kind : jpeg_kinds) {
            files.push_back(encode_jpeg(make_picture(30 + i, 40, channels_of(kind)), kind));
        }
        files.push_back(encode_webp(make_picture(30 + i, 40, 4), i % 2 == 0));
        files.push_back(files.back().substr(0, files.back().size() / 2));
        files.push_back(endless);
    }
    const auto texels = [](const std::string& file) -> std::vector<std::uint8_t> {
        try {
            return decode_texels(view(file), {}).image.bytes;
        } catch (const std::runtime_error&) {
            return {};
        }
    };
    std::vector<std::vector<std::uint8_t>> together(files.size());
    tbb::parallel_for(std::size_t{0}, files.size(),
                      [&](std::size_t i) { together[i] = texels(files[i]); });
    for (std::size_t i = 0; i < files.size(); ++i) {
        REQUIRE(together[i] == texels(files[i]));
        REQUIRE(together[i].empty() == (i % 9 > 6));
    }
}

}  // namespace bdpt::test::decoding_test
