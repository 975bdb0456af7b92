#include <bdpt/error.h>
#include <bdpt/io/read_image.h>
#include <bdpt/io/write_image.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "catch.hpp"
#include "scratch_folder.h"

namespace bdpt::io::image_file_test {
namespace {

using test::ScratchFolder;

Image ascending(int width, int height)
{
    Image image{width, height, {}};
    for (int i = 0; i < width * height; ++i) {
        const float value = static_cast<float>(i);
        image.pixels.emplace_back(value, value + 0.25f, value + 0.5f);
    }
    return image;
}

Error image_error(const std::filesystem::path& file, const ImageOptions& options = {})
{
    try {
        static_cast<void>(read_image(file, options));
    } catch (const Error& error) {
        return error;
    }
    return Error(ErrorCode::internal, "");
}

TEST_CASE("read_image gives what write_exr was given, whatever the values are")
{
    const ScratchFolder folder;
    Image image = ascending(5, 3);
    image.pixels[7] = Rgb(-2.0f, std::numeric_limits<float>::infinity(), 1e30f);
    image.pixels[8].g = std::numeric_limits<float>::quiet_NaN();
    ExrOptions options;
    options.storage = ExrStorage::tiles;
    write_exr(folder / "a.exr", image, options);
    const LoadedImage loaded = read_image(folder / "a.exr");
    REQUIRE(loaded.image.width == 5);
    REQUIRE(loaded.image.height == 3);
    CHECK(loaded.filled == PixelRect{0, 0, 5, 3});
    CHECK(loaded.warnings.empty());
    CHECK(loaded.image.at(4, 1).r == 9.0f);
    CHECK(loaded.image.at(2, 1) == image.pixels[7]);
    CHECK(std::isnan(loaded.image.at(3, 1).g));
    CHECK(loaded.image.at(3, 1).b == 8.5f);
}

TEST_CASE("read_image tells which part of the image a file holds")
{
    const ScratchFolder folder;
    ExrOptions options;
    options.placement = ExrPlacement{.x = 3, .y = 1, .full_width = 9, .full_height = 7};
    write_exr(folder / "crop.exr", ascending(2, 4), options);
    const LoadedImage loaded = read_image(folder / "crop.exr");
    CHECK(loaded.image.width == 9);
    CHECK(loaded.image.height == 7);
    CHECK(loaded.filled == PixelRect{3, 1, 5, 5});
    CHECK(loaded.image.at(4, 2).r == 3.0f);
    CHECK(loaded.image.at(0, 0) == Rgb(0.0f));
}

TEST_CASE("read_image finds layers by their name")
{
    const ScratchFolder folder;
    const auto layer = [](const char* name, const char* channels, float first) {
        Layer result{.name = name, .channels = channels, .width = 1, .height = 1, .values = {}};
        for (std::size_t c = 0; c < result.channels.size(); ++c) {
            result.values.push_back(first + static_cast<float>(c));
        }
        return result;
    };
    const std::vector<Layer> layers{layer("albedo", "RGB", 1), layer("normal", "XYZ", 4),
                                    layer("depth", "Z", 7), layer("", "A", 8),
                                    layer("uv", "UV", 9)};
    const auto file = folder / "layers.exr";
    write_exr(file, Image{1, 1, {Rgb(0.5f)}}, layers, {});
    const auto pixel = [&file](const char* name) {
        return read_image(file, {.layer = name}).image.at(0, 0);
    };
    CHECK(read_image(file).image.at(0, 0) == Rgb(0.5f));
    CHECK(pixel("albedo") == Rgb(1, 2, 3));
    CHECK(pixel("normal") == Rgb(4, 5, 6));
    CHECK(pixel("depth") == Rgb(7));
    CHECK(pixel("A") == Rgb(8));
    CHECK(image_error(file, {.layer = "position"}).code() == ErrorCode::not_found);
    CHECK(image_error(file, {.layer = "uv"}).code() == ErrorCode::unsupported);
    CHECK(image_error(file, {.layer = ""}).code() == ErrorCode::not_found);
}

TEST_CASE("read_image reads Radiance HDR")
{
    const ScratchFolder folder;
    test::write_text(folder / "a.hdr", std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n"
                                                   "-Y 1 +X 1\n\x80\x40\x20\x82"));
    // Mantissas of 1/2, 1/4 and 1/8 times 2^2.
    const Rgb pixel = read_image(folder / "a.hdr").image.at(0, 0);
    CHECK(pixel == Rgb(2.0f, 1.0f, 0.5f));
    CHECK(image_error(folder / "a.hdr", {.layer = "albedo"}).code() == ErrorCode::not_found);

    test::write_text(folder / "a.gif", "GIF89a");
    const Error other = image_error(folder / "a.gif");
    CHECK(other.code() == ErrorCode::unsupported);
    CHECK(other.what() ==
          (folder / "a.gif").string() + ": neither OpenEXR, Radiance HDR, PNG, JPEG nor WebP");
    CHECK(image_error(folder / "none.exr").code() == ErrorCode::not_found);
    write_exr(folder / "whole.exr", ascending(64, 64), {});
    const std::string whole = test::read_text(folder / "whole.exr");
    test::write_text(folder / "cut.exr", whole.substr(0, whole.size() / 2));
    CHECK(image_error(folder / "cut.exr").code() == ErrorCode::invalid_input);
    CHECK(image_error(folder / "whole.exr", {.limits = {.image_side = 63}}).code() ==
          ErrorCode::invalid_input);
}

}  // namespace
}  // namespace bdpt::io::image_file_test
