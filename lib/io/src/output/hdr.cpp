#include <bdpt/io/write_image.h>

#include <bdpt/io/output_file.h>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "output/image_output.h"

namespace bdpt::io {
namespace {

/// Mantissas of red, green and blue and their exponent e: values are mantissa * 2^(e - 136).
using RgbePixel = std::array<std::uint8_t, 4>;

RgbePixel encode_rgbe(const Rgb& color)
{
    constexpr float largest = 0x1.fep126f;  // 255 * 2^119
    std::array<float, 3> values{};
    float most = 0.0f;
    for (int c = 0; c < 3; ++c) {
        // NaN becomes 0, too.
        const float value = color[c] > 0.0f ? std::min(color[c], largest) : 0.0f;
        values[static_cast<std::size_t>(c)] = value;
        most = std::max(most, value);
    }
    int exponent = 0;
    std::frexp(most, &exponent);
    if (std::lround(std::ldexp(most, 8 - exponent)) > 255) {
        ++exponent;  // rounded up to 256
    }
    if (!(most > 0.0f) || exponent < -127) {
        return {};
    }
    RgbePixel pixel{};
    for (std::size_t c = 0; c < 3; ++c) {
        pixel[c] = static_cast<std::uint8_t>(std::lround(std::ldexp(values[c], 8 - exponent)));
    }
    pixel[3] = static_cast<std::uint8_t>(exponent + 128);
    return pixel;
}

/// Appends one component of all pixels of a line: runs of 3 to 127 as 128 + count and the byte,
/// others as their count, of 1 to 128, and their bytes.
void append_component(const std::vector<RgbePixel>& line, std::size_t component, std::string& bytes)
{
    const auto value = [&](std::size_t x) { return static_cast<char>(line[x][component]); };
    const auto run_at = [&](std::size_t x) {
        std::size_t end = x + 1;
        while (end < line.size() && end - x < 127 && value(end) == value(x)) {
            ++end;
        }
        return end - x;
    };
    constexpr std::size_t worth = 3;
    for (std::size_t x = 0; x < line.size();) {
        const std::size_t run = run_at(x);
        if (run >= worth) {
            bytes.push_back(static_cast<char>(128 + run));
            bytes.push_back(value(x));
            x += run;
            continue;
        }
        std::size_t end = x + run;
        while (end < line.size() && end - x < 128 && run_at(end) < worth) {
            ++end;
        }
        bytes.push_back(static_cast<char>(end - x));
        for (; x < end; ++x) {
            bytes.push_back(value(x));
        }
    }
}

void append_line(const std::vector<RgbePixel>& line, std::string& bytes)
{
    // Lines of other lengths have no run-length encoding.
    const bool packed = line.size() >= 8 && line.size() <= 32767;
    if (!packed) {
        for (const RgbePixel& pixel : line) {
            bytes.append(pixel.begin(), pixel.end());
        }
        return;
    }
    bytes += "\x02\x02";
    bytes.push_back(static_cast<char>(line.size() >> 8U));
    bytes.push_back(static_cast<char>(line.size() & 0xffU));
    for (std::size_t component = 0; component < 4; ++component) {
        append_component(line, component, bytes);
    }
}

std::string make_header(const Image& image, const ImageMetadata& metadata)
{
    std::string header = "#?RADIANCE\nSOFTWARE=" + software_name(metadata) + "\n";
    for (auto [name, value] : text_entries(metadata)) {
        std::replace_if(
            value.begin(), value.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
        header += fmt::format("# {}: {}\n", name, value);
    }
    return header +
           fmt::format("FORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", image.height, image.width);
}

}  // namespace

void write_hdr(const std::filesystem::path& file, const Image& image, const ImageMetadata& metadata)
{
    check_pixels(file, image.width, image.height, image.pixels.size());
    std::string bytes = make_header(image, metadata);
    std::vector<RgbePixel> line(static_cast<std::size_t>(image.width));
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            line[static_cast<std::size_t>(x)] = encode_rgbe(image.at(x, y));
        }
        append_line(line, bytes);
    }
    OutputFile output(file);
    output.write(bytes);
    output.commit();
}

}  // namespace bdpt::io
