#include "../gltf_fixture.h"
#include "catch.hpp"

#include <bdpt/io/read_image.h>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfOutputFile.h>
#include <ImfRgbaFile.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <map>

namespace bdpt::test::environment_test {
using namespace bdpt::io;

namespace {

/// Writes an EXR file whose channel values are given pixel by pixel.
void write_exr_channels(const std::filesystem::path& file, const Imath::Box2i& display,
                        const Imath::Box2i& data, Imf::PixelType type,
                        const std::map<std::string, std::vector<float>>& channels,
                        Imf::Compression compression = Imf::ZIP_COMPRESSION)
{
    Imf::Header header(display, data);
    header.compression() = compression;
    std::map<std::string, std::vector<half>> halves;
    Imf::FrameBuffer buffer;
    const auto width = static_cast<std::size_t>(data.max.x - data.min.x + 1);
    for (const auto& [name, values] : channels) {
        header.channels().insert(name, Imf::Channel(type));
        const void* pixels = values.data();
        if (type == Imf::HALF) {
            halves[name] = {values.begin(), values.end()};
            pixels = halves[name].data();
        }
        const std::size_t size = type == Imf::HALF ? 2 : 4;
        buffer.insert(name, Imf::Slice::Make(type, pixels, data, size, size * width));
    }
    Imf::OutputFile output(file.c_str(), header);
    output.setFrameBuffer(buffer);
    output.writePixels(data.max.y - data.min.y + 1);
}

Imath::Box2i box(int x0, int y0, int x1, int y1)
{
    return {{x0, y0}, {x1, y1}};
}

LoadedEnvironment load_exr(const Imath::Box2i& display, const Imath::Box2i& data,
                           Imf::PixelType type,
                           const std::map<std::string, std::vector<float>>& channels)
{
    const TempFolder folder;
    write_exr_channels(folder.path() / "sky.exr", display, data, type, channels);
    return load_environment(folder.path() / "sky.exr");
}

Error environment_error(const std::filesystem::path& file, const ReadLimits& limits = {})
{
    try {
        static_cast<void>(load_environment(file, {.limits = limits}));
    } catch (const Error& error) {
        return error;
    }
    return Error(ErrorCode::internal, "");
}

}  // namespace

TEST_CASE("RGB environments are read in half and in single precision")
{
    for (const Imf::PixelType type : {Imf::HALF, Imf::FLOAT}) {
        const LoadedEnvironment loaded =
            load_exr(box(0, 0, 1, 0), box(0, 0, 1, 0), type,
                     {{"R", {1, 2}}, {"G", {3, 4}}, {"B", {0.5f, 60000}}, {"A", {0, 0}}});
        const EnvironmentImage& image = loaded.light.radiance;
        REQUIRE(image.width() == 2);
        REQUIRE(image.height() == 1);
        CHECK(image.at(0, 0) == Rgb(1, 3, 0.5f));
        CHECK(image.at(1, 0) == Rgb(2, 4, type == Imf::HALF ? float(half(60000.0f)) : 60000.0f));
        CHECK(loaded.warnings.empty());
        CHECK(loaded.light.world_from_environment == Mat3(1.0f));
    }
    // Beyond what half precision holds: the sun.
    CHECK(load_exr(box(0, 0, 0, 0), box(0, 0, 0, 0), Imf::FLOAT,
                   {{"R", {1e9f}}, {"G", {1e-9f}}, {"B", {0}}})
              .light.radiance.at(0, 0) == Rgb(1e9f, 1e-9f, 0));
}

TEST_CASE("environments of halves and of shared exponents take 6 bytes per texel", "[memory]")
{
    const std::vector<float> values{1, 2, 0.125f, -3, 5, 6, 7, 60001};
    for (const Imf::PixelType type : {Imf::HALF, Imf::FLOAT}) {
        const TempFolder folder;
        write_exr_channels(folder.path() / "sky.exr", box(0, 0, 3, 1), box(0, 0, 3, 1), type,
                           {{"R", values}, {"G", values}, {"B", values}});
        MemoryBudget memory({.bytes = 1000000, .source = "the test"});
        const LoadedEnvironment loaded =
            load_environment(folder.path() / "sky.exr", {.memory = &memory});
        const bool exact = type == Imf::HALF;  // 60001 is none
        CHECK(loaded.light.radiance.bytes() == (exact ? 6U : 12U) * values.size());
        CHECK(memory.spent() == (exact ? 8U : 22U) * values.size());
        CHECK(loaded.light.radiance.at(2, 0) == Rgb(0.125f));
        CHECK(loaded.light.radiance.at(3, 0) == Rgb(0));
        CHECK(loaded.light.radiance.at(2, 1) == Rgb(7));
        CHECK(warns(loaded.warnings, {"pixel (3, 0): -3", "and 2 more"}));
    }
    const TempFolder folder;
    const std::string head = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n";
    const std::string rows = "\x80\x40\x20\x81\x90\x80\x80\x80";
    const auto compact = folder.write("sky.hdr", head + "\n-Y 1 +X 2\n" + rows);
    CHECK(load_environment(compact).light.radiance.bytes() == 12);
    const auto upwards = folder.write("up.hdr", head + "\n+Y 2 +X 1\n" + rows);
    CHECK(load_environment(upwards).light.radiance.at(0, 0) == Rgb(0.5625f, 0.5f, 0.5f));
    const auto divided = folder.write("divided.hdr", head + "EXPOSURE=3\n\n-Y 1 +X 2\n" + rows);
    CHECK(load_environment(divided).light.radiance.bytes() == 24);
    // A range that no scale of halves has.
    const auto wide =
        folder.write("wide.hdr", head + "\n-Y 2 +X 1\n" + "\x81\x40\x20\x30\x80\x80\x80\xc0");
    const EnvironmentImage image = load_environment(wide).light.radiance;
    CHECK(image.bytes() == 24);
    CHECK(image.at(0, 0).r == std::ldexp(129.0f, 0x30 - 136));
}

TEST_CASE("tall environments of halves are read in parts, whatever their compression")
{
    constexpr int width = 5;
    constexpr int height = 600;
    std::vector<float> values;
    for (int i = 0; i < width * height; ++i) {
        values.push_back(static_cast<float>(i % 2000));
    }
    for (const Imf::Compression compression :
         {Imf::NO_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION}) {
        const TempFolder folder;
        write_exr_channels(folder.path() / "sky.exr", box(3, -4, 7, 595), box(3, -4, 7, 595),
                           Imf::HALF, {{"Y", values}}, compression);
        const EnvironmentImage image = load_environment(folder.path() / "sky.exr").light.radiance;
        REQUIRE(image.height() == height);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                REQUIRE(image.at(x, y) == Rgb(values[static_cast<std::size_t>(y * width + x)]));
            }
        }
    }
}

TEST_CASE("luminance alone is grey, with chroma it is coloured")
{
    CHECK(load_exr(box(0, 0, 1, 0), box(0, 0, 1, 0), Imf::FLOAT, {{"Y", {0.25f, 7}}})
              .light.radiance.at(1, 0) == Rgb(7));

    const TempFolder folder;
    const std::filesystem::path file = folder.path() / "chroma.exr";
    {
        Imf::RgbaOutputFile output(file.c_str(), 16, 8, Imf::WRITE_YC);
        const std::vector<Imf::Rgba> pixels(128, Imf::Rgba(2.0f, 1.0f, 0.5f));
        output.setFrameBuffer(pixels.data(), 1, 16);
        output.writePixels(8);
    }
    const Rgb pixel = load_environment(file).light.radiance.at(7, 4);
    CHECK(pixel.r == Approx(2).epsilon(0.01));
    CHECK(pixel.g == Approx(1).epsilon(0.01));
    CHECK(pixel.b == Approx(0.5).epsilon(0.01));
}

TEST_CASE("the data window is put into the display window")
{
    const EnvironmentImage image = load_exr(box(10, 20, 13, 21), box(11, 21, 14, 22), Imf::FLOAT,
                                            {{"R", {1, 2, 3, 4, 5, 6, 7, 8}},
                                             {"G", {1, 2, 3, 4, 5, 6, 7, 8}},
                                             {"B", {1, 2, 3, 4, 5, 6, 7, 8}}})
                                       .light.radiance;
    REQUIRE(image.width() == 4);
    REQUIRE(image.height() == 2);
    CHECK(image.at(0, 0) == Rgb(0));
    CHECK(image.at(3, 0) == Rgb(0));
    CHECK(image.at(0, 1) == Rgb(0));
    CHECK(image.at(1, 1) == Rgb(1));
    CHECK(image.at(3, 1) == Rgb(3));
}

TEST_CASE("the first layer with colours is read if none is unnamed")
{
    const LoadedEnvironment loaded =
        load_exr(box(0, 0, 1, 0), box(0, 0, 1, 0), Imf::FLOAT,
                 {{"depth.Z", {9, 9}}, {"sky.R", {1, 1}}, {"sky.G", {2, 2}}, {"sky.B", {3, 3}}});
    CHECK(loaded.light.radiance.at(0, 0) == Rgb(1, 2, 3));
    CHECK(warns(loaded.warnings, {"layer sky"}));
}

TEST_CASE("negative and NaN pixels are black, infinite ones as bright as can be, with warnings")
{
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (const Imf::PixelType type : {Imf::HALF, Imf::FLOAT}) {
        const bool compact = type == Imf::HALF;
        const float greatest = compact ? 65504.0f : 4398046511104.0f;
        const LoadedEnvironment loaded =
            load_exr(box(0, 0, 1, 0), box(0, 0, 1, 0), type,
                     {{"R", {-1, NAN}}, {"G", {1, infinity}}, {"B", {infinity, -infinity}}});
        CHECK(loaded.light.radiance.at(0, 0) == Rgb(0, 1, greatest));
        CHECK(loaded.light.radiance.at(1, 0) == Rgb(0, greatest, 0));
        CHECK(loaded.warnings.size() == 2);
        CHECK(warns(loaded.warnings, {"pixel (0, 0): -1",
                                      "negative and NaN values are treated as 0", "and 2 more"}));
        CHECK(warns(loaded.warnings,
                    {"pixel (0, 0): inf", compact ? "treated as 65504" : "treated as 4.398e+12",
                     "and 1 more"}));
    }
    // Halves that are read as floats, as their data does not fill the image.
    const LoadedEnvironment part = load_exr(box(0, 0, 3, 1), box(0, 0, 0, 0), Imf::HALF,
                                            {{"R", {infinity}}, {"G", {1}}, {"B", {1}}});
    CHECK(part.light.radiance.at(0, 0) == Rgb(65504, 1, 1));
}

TEST_CASE("Radiance images are read")
{
    // Mantissas and a common exponent: value = mantissa * 2^(exponent - 136).
    const std::string pixels{
        "\x80\x40\x20\x81"
        "\x80\x80\x80\x80"
        "\0\0\0\0"
        "\xff\xff\xff\x90",
        16};
    const TempFolder folder;
    const auto file =
        folder.write("sky.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n" + pixels);
    const LoadedEnvironment loaded = load_environment(file);
    const EnvironmentImage& image = loaded.light.radiance;
    REQUIRE(image.width() == 2);
    REQUIRE(image.height() == 2);
    CHECK(image.at(0, 0) == Rgb(1.0f, 0.5f, 0.25f));
    CHECK(image.at(1, 0) == Rgb(0.5f));
    CHECK(image.at(0, 1) == Rgb(0));
    CHECK(image.at(1, 1) == Rgb(65280.0f));
    CHECK(warns(loaded.warnings, {"2 x 2", "twice as wide"}));
}

TEST_CASE("environments that cannot be read are refused")
{
    const TempFolder folder;
    const Error missing = environment_error(folder.path() / "none.exr");
    CHECK(missing.code() == ErrorCode::not_found);
    CHECK(missing.what() == (folder.path() / "none.exr").string() + ": no such file");

    const Error format = environment_error(folder.write("sky.gif", "GIF89a"));
    CHECK(format.code() == ErrorCode::unsupported);
    CHECK(contains(format.what(),
                   "neither OpenEXR, Radiance HDR, TIFF, PNG, JPEG nor WebP, but a GIF image"));
    const Error headless = environment_error(folder.write("sky.png", "\x89PNG\r\n\x1a\n"));
    CHECK(headless.code() == ErrorCode::invalid_input);

    const auto file = folder.path() / "sky.exr";
    write_exr_channels(file, box(0, 0, 3, 1), box(0, 0, 3, 1), Imf::FLOAT,
                       {{"Z", {1, 2, 3, 4, 5, 6, 7, 8}}});
    CHECK(environment_error(file).code() == ErrorCode::unsupported);
    CHECK(contains(environment_error(file).what(), "neither R, G, B nor Y"));

    const std::vector<float> values(8, 1.0f);
    write_exr_channels(file, box(0, 0, 3, 1), box(0, 0, 3, 1), Imf::FLOAT,
                       {{"R", values}, {"G", values}, {"B", values}});
    ReadLimits limits;
    limits.image_side = 3;
    CHECK(environment_error(file, limits).code() == ErrorCode::invalid_input);
    CHECK(contains(environment_error(file, limits).what(), "4 x 2 pixels"));
    limits = {};
    limits.image_bytes = 95;
    CHECK(contains(environment_error(file, limits).what(), "needs 96 B, but the limit is 95 B"));

    std::ifstream stream(file, std::ios::binary);
    const std::string good{std::istreambuf_iterator<char>(stream), {}};
    for (std::size_t size = 0; size < good.size(); ++size) {
        const Error cut = environment_error(folder.write("cut.exr", good.substr(0, size)));
        CAPTURE(size, cut.what());
        CHECK((cut.code() == ErrorCode::invalid_input || cut.code() == ErrorCode::unsupported));
    }
    const Error hdr = environment_error(
        folder.write("cut.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 2\n\x01"));
    CHECK(hdr.code() == ErrorCode::invalid_input);
}

TEST_CASE("a dark environment that is packed a thousandfold is read")
{
    const TempFolder folder;
    const auto file = folder.path() / "night.exr";
    const std::vector<float> dark(std::size_t{4096} * 2048);
    write_exr_channels(file, box(0, 0, 4095, 2047), box(0, 0, 4095, 2047), Imf::HALF,
                       {{"Y", dark}});
    REQUIRE(dark.size() * sizeof(Rgb) > 1000 * std::filesystem::file_size(file));
    CHECK(load_environment(file).light.radiance.width() == 4096);
}

}  // namespace bdpt::test::environment_test
