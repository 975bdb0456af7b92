#include "../gltf_fixture.h"
#include "catch.hpp"

#include <bdpt/error.h>
#include <bdpt/io/read_image.h>

#include <optional>

namespace bdpt::test::tiff_test {
using namespace bdpt::io;

namespace {

/// A TIFF image of one strip, not compressed [TIFF 6.0], in the byte order of the machine.
struct Tiff {
    int width = 0;
    int height = 0;
    int channels = 0;
    std::string pixels{};
    int bits = 32;
    int sample_format = 3;  ///< 1: integers, 3: floats
    int orientation = 1;
    std::optional<int> tile{};  ///< side, in place of strips

    [[nodiscard]] std::string bytes() const
    {
        std::vector<std::uint32_t> entries;
        // Tags must be in order.
        const auto put = [&entries](std::uint32_t tag, int value) {
            constexpr std::uint32_t integer = 4;
            entries.insert(entries.end(),
                           {tag | integer << 16U, 1, static_cast<std::uint32_t>(value)});
        };
        const int size = static_cast<int>(pixels.size());
        constexpr int after_header = 8;
        put(256, width);
        put(257, height);
        put(258, bits);
        put(259, 1);
        put(262, channels < 3 ? 1 : 2);
        if (!tile) {
            put(273, after_header);
        }
        put(274, orientation);
        put(277, channels);
        if (tile) {
            put(322, *tile);
            put(323, *tile);
            put(324, after_header);
            put(325, size);
        } else {
            put(278, height);
            put(279, size);
        }
        if (channels % 2 == 0) {
            put(338, 2);  // alpha that is not multiplied in
        }
        put(339, sample_format);
        const auto count = static_cast<std::uint16_t>(entries.size() / 3);
        return "II*" + std::string(1, '\0') +
               bytes_of<std::uint32_t>({static_cast<std::uint32_t>(after_header + size)}) + pixels +
               bytes_of<std::uint16_t>({count}) + bytes_of(entries) + std::string(4, '\0');
    }
};

Tiff floats(int width, int height, int channels, const std::vector<float>& values)
{
    return {.width = width, .height = height, .channels = channels, .pixels = bytes_of(values)};
}

LoadedEnvironment load(const std::string& file, const ReadLimits& limits = {})
{
    const TempFolder folder;
    return load_environment(folder.write("sky.tif", file), {.limits = limits});
}

void check_refusal(const std::string& file, ErrorCode code, const std::string& part,
                   const ReadLimits& limits = {})
{
    try {
        static_cast<void>(load(file, limits));
        FAIL("is read");
    } catch (const Error& error) {
        CHECK(error.code() == code);
        CHECK(contains(error.what(), "sky.tif: "));
        CHECK(contains(error.what(), part));
        CHECK(std::string(error.what()).find('\n') == std::string::npos);
    }
}

}  // namespace

TEST_CASE("TIFF environments of floats are read")
{
    const std::vector<float> values{1, 2, 3, 1e9f, 1e-9f, 0.1f};
    const LoadedEnvironment rgb = load(floats(2, 1, 3, values).bytes());
    CHECK(rgb.light.radiance.to_image().pixels ==
          std::vector<Rgb>{Rgb(1, 2, 3), Rgb(1e9f, 1e-9f, 0.1f)});
    CHECK(rgb.warnings.empty());
    // Colours are taken as they are, whatever alpha is.
    const std::vector<float> with_alpha{1, 2, 3, 0, 4, 5, 6, 0.5f};
    CHECK(load(floats(2, 1, 4, with_alpha).bytes()).light.radiance.to_image().pixels ==
          std::vector<Rgb>{Rgb(1, 2, 3), Rgb(4, 5, 6)});
    CHECK(load(floats(2, 1, 2, {7, 0.5f, 3, 0}).bytes()).light.radiance.to_image().pixels ==
          std::vector<Rgb>{Rgb(7), Rgb(3)});
    CHECK(load(floats(2, 1, 1, {7, -1}).bytes()).light.radiance.to_image().pixels ==
          std::vector<Rgb>{Rgb(7), Rgb(0)});
    CHECK(warns(load(floats(2, 1, 1, {7, -1}).bytes()).warnings, {"pixel (1, 0): -1"}));

    Tiff half = floats(2, 1, 3, {});
    half.pixels = bytes_of<std::uint16_t>({0x3c00, 0x4000, 0x4200, 0x7bff, 0, 0x3800});
    half.bits = 16;
    CHECK(load(half.bytes()).light.radiance.to_image().pixels ==
          std::vector<Rgb>{Rgb(1, 2, 3), Rgb(65504, 0, 0.5f)});
}

TEST_CASE("TIFF environments that would be taken wrongly are refused")
{
    Tiff integers = floats(2, 1, 3, {});
    integers.pixels = std::string(6, '\x7f');
    integers.bits = 8;
    integers.sample_format = 1;
    check_refusal(integers.bytes(), ErrorCode::unsupported,
                  "TIFF: integers, but only floats are taken as linear light");
    Tiff turned = floats(2, 1, 1, {1, 2});
    turned.orientation = 3;
    check_refusal(turned.bytes(), ErrorCode::unsupported,
                  "TIFF: orientation 3, but only 1 (upright) is read");
}

TEST_CASE("TIFF environments are refused by their header, before they are decoded")
{
    Tiff huge = floats(16000, 16000, 3, {1, 2, 3});
    check_refusal(huge.bytes(), ErrorCode::invalid_input, "16000 x 16000 pixels");
    huge.width = 16385;
    check_refusal(huge.bytes(), ErrorCode::invalid_input, "limit is 16384 a side");
    Tiff tiled = floats(2, 2, 3, std::vector<float>(16 * 16 * 3, 1.0f));
    tiled.tile = 16;
    CHECK(load(tiled.bytes()).light.radiance.to_image().pixels == std::vector<Rgb>(4, Rgb(1)));
    tiled.tile = 16000;
    check_refusal(tiled.bytes(), ErrorCode::invalid_input, "16000 x 16000 pixels");
    ReadLimits limits;
    limits.image_bytes = 23;
    check_refusal(floats(2, 1, 1, {1, 2}).bytes(), ErrorCode::invalid_input,
                  "needs 24 B, but the limit is 23 B", limits);
}

TEST_CASE("TIFF environments that are cut off are refused")
{
    const std::string whole = floats(4, 2, 3, std::vector<float>(24, 1.0f)).bytes();
    for (std::size_t size = 4; size < whole.size() - 12; size += 5) {
        CAPTURE(size);
        check_refusal(whole.substr(0, size), ErrorCode::invalid_input, "TIFF: ");
    }
}

}  // namespace bdpt::test::tiff_test
