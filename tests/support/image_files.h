#pragma once

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFloatAttribute.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfIntAttribute.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <bdpt/image.h>
#include <png.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace bdpt::test {

/// An EXR file read by OpenEXR itself.
struct ExrFile {
    Imf::Header header;
    Image image;

    [[nodiscard]] std::string text(const char* name) const
    {
        return header.typedAttribute<Imf::StringAttribute>(name).value();
    }
    [[nodiscard]] int integer(const char* name) const
    {
        return header.typedAttribute<Imf::IntAttribute>(name).value();
    }
    [[nodiscard]] float number(const char* name) const
    {
        return header.typedAttribute<Imf::FloatAttribute>(name).value();
    }
};

[[nodiscard]] inline ExrFile read_exr(const std::filesystem::path& file)
{
    Imf::InputFile exr(file.c_str());
    ExrFile result{exr.header(), {}};
    const Imath::Box2i window = exr.header().dataWindow();
    Image& image = result.image;
    image.width = window.max.x - window.min.x + 1;
    image.height = window.max.y - window.min.y + 1;
    const std::size_t stride = sizeof(Rgb) * static_cast<std::size_t>(image.width);
    image.pixels.resize(static_cast<std::size_t>(image.width) *
                        static_cast<std::size_t>(image.height));
    Imf::FrameBuffer buffer;
    const char* const names[]{"R", "G", "B"};
    for (std::size_t channel = 0; channel < 3; ++channel) {
        if (exr.header().channels().findChannel(names[channel]) == nullptr) {
            throw std::runtime_error(file.string() + ": lacks a channel");
        }
        buffer.insert(names[channel],
                      Imf::Slice::Make(Imf::FLOAT, &image.pixels.front().x + channel, window,
                                       sizeof(Rgb), stride));
    }
    exr.setFrameBuffer(buffer);
    exr.readPixels(window.min.y, window.max.y);
    return result;
}

/// Reads one channel of an EXR file, as floats.
[[nodiscard]] inline std::vector<float> read_exr_channel(const std::filesystem::path& file,
                                                         const char* name)
{
    Imf::InputFile exr(file.c_str());
    if (exr.header().channels().findChannel(name) == nullptr) {
        throw std::runtime_error(file.string() + ": lacks channel " + name);
    }
    const Imath::Box2i window = exr.header().dataWindow();
    const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
    std::vector<float> values(width * static_cast<std::size_t>(window.max.y - window.min.y + 1));
    Imf::FrameBuffer buffer;
    buffer.insert(name, Imf::Slice::Make(Imf::FLOAT, values.data(), window, sizeof(float),
                                         sizeof(float) * width));
    exr.setFrameBuffer(buffer);
    exr.readPixels(window.min.y, window.max.y);
    return values;
}

/// A PNG file read by libpng itself.
struct PngFile {
    int width = 0;
    int height = 0;
    bool has_srgb_chunk = false;
    int channels = 0;
    int bits = 0;  ///< per channel
    std::map<std::string, std::string> text;
    std::vector<std::uint16_t> values;  ///< values of all channels
    std::vector<std::uint8_t> rgb;      ///< colours of a file of 8 bits
};

[[nodiscard]] inline PngFile read_png(const std::filesystem::path& file)
{
    std::FILE* stream = std::fopen(file.c_str(), "rb");
    if (stream == nullptr) {
        throw std::runtime_error("cannot open " + file.string());
    }
    // Without an error handler libpng ends the process on an error, which fails the test.
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, stream);
    png_read_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);

    PngFile result;
    result.width = static_cast<int>(png_get_image_width(png, info));
    result.height = static_cast<int>(png_get_image_height(png, info));
    result.channels = png_get_channels(png, info);
    result.bits = png_get_bit_depth(png, info);
    int intent = 0;
    result.has_srgb_chunk = png_get_sRGB(png, info, &intent) != 0;
    png_textp texts = nullptr;
    const int count = png_get_text(png, info, &texts, nullptr);
    for (int i = 0; i < count; ++i) {
        result.text[texts[i].key] = texts[i].text;
    }
    png_bytepp rows = png_get_rows(png, info);
    const int row_values = result.channels * result.width;
    for (int y = 0; y < result.height; ++y) {
        for (int i = 0; i < row_values; ++i) {
            const int value =
                result.bits == 16 ? 256 * rows[y][2 * i] + rows[y][2 * i + 1] : int{rows[y][i]};
            result.values.push_back(static_cast<std::uint16_t>(value));
            if (result.bits == 8 && i % result.channels < 3) {
                result.rgb.push_back(rows[y][i]);
            }
        }
    }
    png_destroy_read_struct(&png, &info, nullptr);
    std::fclose(stream);
    return result;
}

}  // namespace bdpt::test
