#include "../image_fixture.h"
#include "catch.hpp"
#include "encoders.h"
#include "hdr_encoder.h"
#include "image/encoded_image.h"
#include "image/linear/image_readers.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>

namespace bdpt::test::against_openimageio_test {
using namespace bdpt::io;

namespace {

/// The integer that is stored.
int value_of(const TexelImage& image, std::size_t i)
{
    if (image.type == TexelType::unorm8) {
        return image.bytes[i];
    }
    std::uint16_t word = 0;
    std::memcpy(&word, image.bytes.data() + 2 * i, sizeof word);
    return word;
}

/// The same image by OpenImageIO. `is_close` compares value i of ours, theirs, and ours times
/// alpha.
template <typename IsClose>
void compare(const char* format, const std::string& file, const IsClose& is_close)
{
    const TexelImage ours = decode_texels(view(file), {}).image;
    const OiioImage theirs = OiioLibrary().open(format, view(file));
    REQUIRE(ours.width == theirs.header().width);
    REQUIRE(ours.height == theirs.header().height);
    REQUIRE(ours.channels == theirs.header().channels);
    std::vector<float> values(theirs.value_count());
    theirs.read(values.data());
    const double most = ours.type == TexelType::unorm8 ? 255.0 : 65535.0;
    const auto channels = static_cast<std::size_t>(ours.channels);
    int different = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const int value = value_of(ours, i);
        const double alpha =
            i % channels == 3 ? 1.0 : value_of(ours, i - i % channels + channels - 1) / most;
        different +=
            is_close(value, static_cast<int>(std::lround(values[i] * most)), value * alpha) ? 0 : 1;
    }
    CHECK(different == 0);
}

void compare_hdr(const std::string& file)
{
    Warnings warnings;
    const Image ours = read_hdr(view(file), {}, warnings);
    const OiioImage theirs = OiioLibrary().open("hdr", view(file));
    REQUIRE(ours.width == theirs.header().width);
    REQUIRE(ours.height == theirs.header().height);
    std::vector<Rgb> values(ours.pixels.size());
    REQUIRE(theirs.value_count() == 3 * values.size());
    theirs.read(&values[0].r);
    CHECK((ours.pixels == values));  // not taken apart: a failure would print a million pixels
}

constexpr auto equal = [](int ours, int theirs, double) { return ours == theirs; };

}  // namespace

TEST_CASE("JPEG images are read as OpenImageIO reads them")
{
    for (const JpegKind kind :
         {JpegKind::baseline, JpegKind::subsampled, JpegKind::progressive, JpegKind::restarts,
          JpegKind::grey, JpegKind::rgb, JpegKind::cmyk, JpegKind::ycck}) {
        CAPTURE(static_cast<int>(kind));
        const std::string file = encode_jpeg(make_picture(61, 47, channels_of(kind)), kind);
        compare("jpeg", file, equal);
        compare("jpeg", file.substr(0, file.size() * 2 / 3), equal);
    }
}

TEST_CASE("WebP images are read as OpenImageIO reads them, but for alpha")
{
    for (const bool lossless : {false, true}) {
        compare("webp", encode_webp(make_picture(61, 47, 3), lossless), equal);
        // OpenImageIO 2.4 multiplies colours by alpha and rounds them, whatever it is asked for.
        compare("webp", encode_webp(make_picture(61, 47, 4), lossless),
                [](int ours, int theirs, double multiplied) {
                    return ours == theirs || std::abs(theirs - multiplied) <= 1.0;
                });
    }
}

TEST_CASE("PNG images are read as OpenImageIO reads them")
{
    struct Layout {
        int color_type;
        int channels;
        std::vector<int> depths;
        std::string transparent;  // tRNS
    };
    const std::vector<Layout> layouts{{0, 1, {1, 2, 4, 8, 16}, raw({0, 1})},
                                      {2, 3, {8, 16}, raw({0, 7, 0, 8, 0, 9})},
                                      {3, 1, {1, 2, 4, 8}, raw({255, 77})},
                                      {4, 2, {8, 16}, ""},
                                      {6, 4, {8, 16}, ""}};
    std::uint32_t noise = 1;
    for (const Layout& layout : layouts) {
        for (const int depth : layout.depths) {
            CAPTURE(layout.color_type, depth);
            constexpr int width = 16;
            std::vector<std::string> rows(2);
            for (std::string& row : rows) {
                for (int i = 0; i < width * layout.channels * depth / 8; ++i) {
                    noise = noise * 1664525U + 1013904223U;
                    row.push_back(static_cast<char>(noise >> 24U));
                }
            }
            std::string palette;
            for (int i = 0; i < 3 << depth && layout.color_type == 3; ++i) {
                palette.push_back(static_cast<char>(37 * i));
            }
            const std::string colors =
                palette.empty()
                    ? ""
                    : png_chunk("PLTE", palette) + png_chunk("gAMA", raw({0, 0, 177, 143}));
            compare("png", png(width, 2, depth, layout.color_type, rows, colors), equal);
            if (!layout.transparent.empty()) {
                compare("png",
                        png(width, 2, depth, layout.color_type, rows,
                            colors + png_chunk("tRNS", layout.transparent)),
                        equal);
            }
        }
    }
}

TEST_CASE("Radiance HDR images are read as OpenImageIO reads them")
{
    // It does not know the older encoding, and turns no image upright.
    for (const HdrEncoding encoding : {HdrEncoding::flat, HdrEncoding::newer}) {
        compare_hdr(upright(301, 17, make_pixels(301 * 17, 300), encoding).bytes());
    }
    const char* folder = std::getenv("BDPT_TEST_ASSETS");
    if (folder == nullptr) {
        WARN("real files are skipped: BDPT_TEST_ASSETS is not set");
        return;
    }
    int count = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(folder) / "hdr")) {
        if (entry.path().extension() == ".hdr") {
            std::ifstream stream(entry.path(), std::ios::binary);
            compare_hdr({std::istreambuf_iterator<char>(stream), {}});
            ++count;
        }
    }
    CHECK(count >= 2);
}

}  // namespace bdpt::test::against_openimageio_test
