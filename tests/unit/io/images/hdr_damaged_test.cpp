#include "../image_fixture.h"
#include "catch.hpp"
#include "encoders.h"
#include "hdr_encoder.h"
#include "image/linear/image_readers.h"

#include <bdpt/error.h>

#include <algorithm>
#include <optional>

namespace bdpt::test::hdr_damaged_test {
using namespace bdpt::io;

namespace {

/// What a file is refused for; none if it is read.
std::optional<Error> refusal(const std::string& file, const ReadLimits& limits = {})
{
    Warnings warnings;
    try {
        const Image image = read_hdr(view(file), limits, warnings);
        CHECK(image.pixels.size() == static_cast<std::size_t>(image.width * image.height));
        return std::nullopt;
    } catch (const Error& error) {
        return error;
    }
}

void check_refusal(const std::string& file, ErrorCode code, const std::string& message)
{
    const std::optional<Error> error = refusal(file);
    CAPTURE(message);
    REQUIRE(error);
    CHECK(error->code() == code);
    CHECK(error->what() == message);
}

void check_broken(const std::string& file, const std::string& message)
{
    check_refusal(file, ErrorCode::invalid_input, "Radiance HDR: " + message);
}

/// A file of a header and these bytes.
std::string with_pixels(int width, int height, const std::string& bytes)
{
    return upright(width, height, {}, HdrEncoding::flat).bytes() + bytes;
}

std::string with_lines(const std::string& lines)
{
    HdrFile file = upright(1, 1, {{128, 64, 32, 129}}, HdrEncoding::flat);
    file.lines = lines;
    return file.bytes();
}

std::string with_resolution(const std::string& resolution)
{
    return HdrFile{.resolution = resolution}.bytes() + std::string(64, '\x80');
}

std::vector<std::string> sound_files()
{
    std::vector<std::string> files;
    for (const HdrEncoding encoding : {HdrEncoding::flat, HdrEncoding::older, HdrEncoding::newer}) {
        HdrFile file = upright(20, 3, make_pixels(60, 15), encoding);
        file.lines = "EXPOSURE=0.5\nCOLORCORR=1 2 3\n";
        files.push_back(file.bytes());
    }
    return files;
}

}  // namespace

TEST_CASE("broken headers of Radiance HDR images are refused by their line")
{
    check_broken("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n", "the file ends within the header");
    check_broken("#?RADIANCE", "the file ends within the header");
    check_broken("#?RADIANCE\n\n-Y 1 +X 1\n\x80\x80\x80\x80",
                 "the header has no line FORMAT=32-bit_rle_rgbe");
    for (const char* value : {"0", "-1", "nan", "inf", "1e999", "", "one", "0x2", "2,5"}) {
        const std::string line = std::string("EXPOSURE=") + value;
        check_broken(with_lines(line + "\n"), "\"" + line + "\": not positive and finite");
    }
    check_broken(with_lines("COLORCORR=1 2\n"), "\"COLORCORR=1 2\": not positive and finite");
    check_broken(with_lines("COLORCORR=1 0 2\n"), "\"COLORCORR=1 0 2\": not positive and finite");
    check_broken(with_lines("EXPOSURE=1e200\nEXPOSURE=1e-300\nEXPOSURE=1e-300\n"),
                 "\"EXPOSURE=1e-300\": not positive and finite");
    check_refusal(with_lines("FORMAT=32-bit_rle_xyze\n"), ErrorCode::unsupported,
                  "Radiance HDR: \"FORMAT=32-bit_rle_xyze\": only pixels of the format "
                  "32-bit_rle_rgbe are read");
    check_refusal(with_lines("FORMAT=32-bit_rle_rgbe x\n"), ErrorCode::unsupported,
                  "Radiance HDR: \"FORMAT=32-bit_rle_rgbe x\": only pixels of the format "
                  "32-bit_rle_rgbe are read");
    for (const char* resolution : {"-Y 2 +Y 2", "-X 2 +X 2", "Y 2 +X 2", "-Y 2", "", "-Y 0 +X 2",
                                   "-Y -2 +X 2", "-Y 2 +X 2 3", "-Y 2.5 +X 2",
                                   "-Y 99999999999 +X 2", "+Z 2 +X 2", "-Y2 +X2", "-Y 2 +X 2\r"}) {
        std::string shown = resolution;
        std::replace(shown.begin(), shown.end(), '\r', '?');
        check_broken(with_resolution(resolution),
                     "resolution \"" + shown + "\", not such as \"-Y 512 +X 1024\"");
    }
}

TEST_CASE("broken scanlines of Radiance HDR images are refused by their number")
{
    const std::string line = encode_scanline(make_pixels(9, 3), HdrEncoding::newer);
    check_broken(with_pixels(9, 2, line), "scanline 2: the file ends too early");
    check_broken(with_pixels(9, 2, line + "\2\2\1\2"),
                 "scanline 2: has another length than the image");
    const std::string mark{2, 2, 0, 9};
    check_broken(with_pixels(9, 1, mark + raw({137})), "scanline 1: the file ends too early");
    check_broken(with_pixels(9, 1, mark + raw({138, 5})), "scanline 1: a run goes past its end");
    check_broken(with_pixels(9, 1, mark + raw({255, 5})), "scanline 1: a run goes past its end");
    check_broken(with_pixels(9, 1, mark + raw({10, 5})), "scanline 1: a run goes past its end");
    check_broken(with_pixels(9, 1, mark + raw({128, 5})), "scanline 1: a run goes past its end");
    check_broken(with_pixels(9, 1, mark + raw({135, 5, 3, 5, 5, 5})),
                 "scanline 1: a run goes past its end");
    check_broken(with_pixels(9, 1, mark + raw({0, 0, 0})), "scanline 1: an empty run");

    const std::string pixel = raw({9, 130, 9, 136});
    check_broken(with_pixels(9, 1, raw({1, 1, 1, 4})), "scanline 1: begins with a repetition");
    check_broken(with_pixels(9, 1, pixel + raw({1, 1, 1, 9})),
                 "scanline 1: a run goes past its end");
    check_broken(with_pixels(9, 1, pixel + raw({1, 1, 1, 7, 1, 1, 1, 1})),
                 "scanline 1: a run goes past its end");
    std::string digits = pixel;
    for (int i = 0; i < 5; ++i) {
        digits += raw({1, 1, 1, 0});
    }
    check_broken(with_pixels(9, 1, digits), "scanline 1: a run goes past its end");
    check_broken(with_pixels(9, 1, pixel + raw({1, 1, 1, 7, 1, 1})),
                 "scanline 1: the file ends too early");
}

TEST_CASE("a Radiance HDR image is refused by its header, before memory is taken")
{
    const auto expect = [](const std::string& file, const ReadLimits& limits,
                           const std::string& part) {
        const std::optional<Error> error = refusal(file, limits);
        REQUIRE(error);
        CAPTURE(error->what());
        CHECK(error->code() == ErrorCode::invalid_input);
        CHECK(contains(error->what(), part));
    };
    expect(with_resolution("-Y 16000 +X 16000"), {}, "needs 3.07 GB, but the limit is 2.15 GB");
    expect(with_resolution("-Y 16385 +X 1"), {}, "1 x 16385 pixels, but the limit is 16384");
    expect(with_resolution("+X 2147483647 -Y 2147483647"), {}, "the limit is 16384 a side");
    ReadLimits limits;
    limits.image_side = 1 << 30;
    expect(with_resolution("-Y 1000000000 +X 1000000000"), limits, "but the limit is 2");
    limits = {};
    limits.image_bytes = 71;
    expect(with_resolution("-Y 2 +X 3"), limits, "needs 72 B, but the limit is 71 B");
}

TEST_CASE("Radiance HDR images that are cut off anywhere are refused")
{
    for (const std::string& file : sound_files()) {
        REQUIRE(!refusal(file));
        for (std::size_t size = 0; size < file.size(); ++size) {
            const std::optional<Error> error = refusal(file.substr(0, size));
            CAPTURE(size);
            REQUIRE(error);
            REQUIRE(error->code() == ErrorCode::invalid_input);
        }
    }
}

TEST_CASE("Radiance HDR images with any byte changed are read or refused in one line")
{
    ReadLimits limits;
    limits.image_side = 1024;
    int refused = 0;
    for (const std::string& file : sound_files()) {
        for (std::size_t i = 0; i < file.size(); ++i) {
            for (const int change : {1, 2, 4, 8, 16, 32, 64, 128, 255}) {
                std::string changed = file;
                changed[i] = static_cast<char>(changed[i] ^ change);
                if (const std::optional<Error> error = refusal(changed, limits)) {
                    ++refused;
                    const std::string what = error->what();
                    REQUIRE((error->code() == ErrorCode::invalid_input ||
                             error->code() == ErrorCode::unsupported));
                    REQUIRE(what.find_first_of("\n\r") == std::string::npos);
                }
            }
        }
    }
    CHECK(refused > 1000);
}

}  // namespace bdpt::test::hdr_damaged_test
