#include "../gltf_fixture.h"
#include "catch.hpp"
#include "encoders.h"
#include "image/encoded_image.h"
#include "scratch_folder.h"

#include <bdpt/error.h>
#include <bdpt/io/read_image.h>
#include <bdpt/io/write_image.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace bdpt::test::picture_test {
using namespace bdpt::io;

namespace {

/// Slopes, another in each channel.
TexelImage slopes(int width, int height, int channels)
{
    TexelImage image{.width = width, .height = height, .bytes = {}, .channels = channels};
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            for (int c = 0; c < channels; ++c) {
                image.bytes.push_back(
                    static_cast<std::uint8_t>((40 + 3 * x * (c + 1) + 2 * y * (3 - c)) % 251));
            }
        }
    }
    return image;
}

PngOptions with_metadata()
{
    PngOptions options;
    options.metadata.version = "1.2";
    options.metadata.scene = "room.glb";
    return options;
}

TexelImage read_back(const std::filesystem::path& file)
{
    const std::string bytes = read_text(file);
    return decode_texels(view(bytes), {}).image;
}

/// Of the values of two images of the same layout.
double mean_difference(const TexelImage& a, const TexelImage& b)
{
    REQUIRE(a.bytes.size() == b.bytes.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < a.bytes.size(); ++i) {
        sum += std::abs(int{a.bytes[i]} - int{b.bytes[i]});
    }
    return sum / static_cast<double>(a.bytes.size());
}

Error error_of(const std::function<void()>& work)
{
    try {
        work();
    } catch (const Error& error) {
        return error;
    }
    throw std::logic_error("nothing was refused");
}

TEST_CASE("JPEG files show what was written, and say how it came about", "[picture]")
{
    const ScratchFolder folder;
    for (const int channels : {1, 3}) {
        const TexelImage image = slopes(24, 17, channels);
        write_jpeg(folder / "a.jpg", image, with_metadata());
        const TexelImage read = read_back(folder / "a.jpg");
        CHECK(read.width == 24);
        CHECK(read.height == 17);
        CHECK(read.channels == channels);
        CHECK(mean_difference(read, image) < 2.5);
    }
    const std::string bytes = read_text(folder / "a.jpg");
    CHECK(bytes.find("Software: bdpt 1.2") != std::string::npos);
    CHECK(bytes.find("bdpt.scene: room.glb") != std::string::npos);
}

TEST_CASE("WebP files show what was written, alpha to the bit", "[picture]")
{
    const ScratchFolder folder;
    for (const int channels : {3, 4}) {
        TexelImage image = slopes(24, 17, channels);
        for (std::size_t i = 3; channels == 4 && i < image.bytes.size(); i += 4) {
            image.bytes[i] = static_cast<std::uint8_t>(i % 7 == 0 ? 200 : 255);
        }
        write_webp(folder / "a.webp", image, with_metadata());
        const TexelImage read = read_back(folder / "a.webp");
        CHECK(read.channels == channels);
        CHECK(mean_difference(read, image) < 4.0);
        for (std::size_t i = 3; channels == 4 && i < image.bytes.size(); i += 4) {
            REQUIRE(read.bytes[i] == image.bytes[i]);
        }
        CHECK(read_text(folder / "a.webp").find("\nbdpt.scene: room.glb\n") != std::string::npos);
    }
}

TEST_CASE("Radiance HDR files keep values to 1 / 256 of the largest channel", "[picture]")
{
    const ScratchFolder folder;
    // Widths with and without run-length encoding, with runs and without.
    for (const int width : {1, 7, 8, 300}) {
        Image image{width, 5, {}};
        for (int i = 0; i < 5 * width; ++i) {
            const bool flat = i % 97 < 60;
            const auto value = flat ? 0.3f : std::exp2(static_cast<float>(i % 61) - 30.0f);
            image.pixels.emplace_back(value, 0.37f * value, i % 3 == 0 ? 0.0f : 0.9999f * value);
        }
        write_hdr(folder / "a.hdr", image, with_metadata().metadata);
        const Image read = read_image(folder / "a.hdr").image;
        REQUIRE(read.width == width);
        REQUIRE(read.height == 5);
        for (std::size_t i = 0; i < image.pixels.size(); ++i) {
            const float most = image.pixels[i].x;
            for (int c = 0; c < 3; ++c) {
                REQUIRE(std::abs(read.pixels[i][c] - image.pixels[i][c]) <= most / 256.0f);
            }
        }
    }
    CHECK(read_text(folder / "a.hdr").find("# bdpt.scene: room.glb\n") != std::string::npos);
}

TEST_CASE("what Radiance HDR cannot hold becomes 0 or the most that it can", "[picture]")
{
    const ScratchFolder folder;
    constexpr float infinite = std::numeric_limits<float>::infinity();
    const Image image{5,
                      1,
                      {Rgb(-1.0f, 1.0f, std::nanf("")), Rgb(infinite, 0.0f, 0.0f), Rgb(1e-45f),
                       Rgb(0.0f), Rgb(0.99999994f)}};
    write_hdr(folder / "a.hdr", image, {});
    const Image read = read_image(folder / "a.hdr").image;
    CHECK(read.pixels[0] == Rgb(0.0f, 1.0f, 0.0f));
    CHECK(read.pixels[1].x > 1.6e38f);
    CHECK(std::isfinite(read.pixels[1].x));
    CHECK(read.pixels[2] == Rgb(0.0f));
    CHECK(read.pixels[3] == Rgb(0.0f));
    CHECK(read.pixels[4] == Rgb(1.0f));
}

TEST_CASE("images that are no pictures are not written", "[picture]")
{
    const ScratchFolder folder;
    const auto refuses = [&](const TexelImage& image) {
        CHECK(error_of([&] { write_jpeg(folder / "a", image, {}); }).code() == ErrorCode::usage);
        CHECK(error_of([&] { write_webp(folder / "a", image, {}); }).code() == ErrorCode::usage);
    };
    refuses({});
    refuses(slopes(4, 4, 2));
    TexelImage part = slopes(4, 4, 3);
    part.bytes.pop_back();
    refuses(part);
    TexelImage deep = slopes(4, 4, 3);
    deep.type = TexelType::unorm16;
    refuses(deep);
    CHECK(error_of([&] { write_webp(folder / "a", slopes(16384, 1, 3), {}); }).code() ==
          ErrorCode::usage);
    CHECK(error_of([&] { write_jpeg(folder / "a", slopes(65535, 1, 3), {}); }).code() ==
          ErrorCode::output);
    CHECK(error_of([&] { write_hdr(folder / "a", {}, {}); }).code() == ErrorCode::usage);
    CHECK(folder.names().empty());
}

TEST_CASE("an environment for screens is sRGB-encoded", "[picture]")
{
    const ScratchFolder folder;
    TexelImage image{.width = 2, .height = 1, .bytes = {255, 0, 188, 0, 64, 255}, .channels = 3};
    write_png(folder / "sky.png", image, {});
    const LoadedEnvironment sky = load_environment(folder / "sky.png");
    const Image radiance = sky.light.radiance.to_image();
    REQUIRE(radiance.width == 2);
    CHECK(radiance.pixels[0].x == 1.0f);
    CHECK(radiance.pixels[0].y == 0.0f);
    CHECK(radiance.pixels[0].z == Approx(0.5029).margin(1e-4));
    CHECK(radiance.pixels[1].y == Approx(0.0513).margin(1e-4));
    REQUIRE(sky.warnings.size() == 1);
    CHECK(sky.warnings[0].find("brighter than white") != std::string::npos);
    CHECK(read_image(folder / "sky.png").image.pixels == radiance.pixels);
    // Grey, with alpha, of 16 bits.
    image = {.width = 2,
             .height = 1,
             .bytes = {0xff, 0xff, 0, 0, 0, 0, 0xff, 0xff},
             .channels = 2,
             .type = TexelType::unorm16};
    write_png(folder / "grey.png", image, {});
    const Image grey = read_image(folder / "grey.png").image;
    CHECK(grey.pixels[0] == Rgb(1.0f));
    CHECK(grey.pixels[1] == Rgb(0.0f));
}

TEST_CASE("an environment that lies about its size is refused", "[picture]")
{
    const ScratchFolder folder;
    write_png(folder / "sky.png", slopes(4, 2, 3), {});
    const auto refused = [&](const std::string& bytes, const char* what) {
        write_text(folder / "lie.png", bytes);
        const Error error =
            error_of([&] { static_cast<void>(load_environment(folder / "lie.png")); });
        CAPTURE(error.what());
        CHECK(error.code() == ErrorCode::invalid_input);
        CHECK(std::string(error.what()).find(what) != std::string::npos);
    };
    std::string whole = read_text(folder / "sky.png");
    refused(whole.substr(0, whole.size() / 2), "PNG");
    refused(whole.substr(0, 20), "PNG");
    std::string jpeg = [&] {
        write_jpeg(folder / "sky.jpg", slopes(64, 32, 3), {});
        return read_text(folder / "sky.jpg");
    }();
    // A frame header of 65500 x 65500 pixels.
    const std::size_t frame = jpeg.find("\xff\xc0");
    REQUIRE(frame != std::string::npos);
    jpeg.replace(frame + 5, 4, "\xff\xdc\xff\xdc");
    refused(jpeg, "65500");
    MemoryBudget small({.bytes = 1000, .source = "a test"});
    CHECK(error_of([&] {
              static_cast<void>(load_environment(folder / "sky.jpg", {.memory = &small}));
          }).code() == ErrorCode::invalid_input);
}

}  // namespace
}  // namespace bdpt::test::picture_test
