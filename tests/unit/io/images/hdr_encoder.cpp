#include "hdr_encoder.h"

#include <algorithm>
#include <cstdint>
#include <iterator>

namespace bdpt::io {

namespace {

void put(std::string& file, std::size_t byte)
{
    file.push_back(static_cast<char>(byte));
}

void put(std::string& file, const Rgbe& pixel)
{
    for (const std::uint8_t byte : pixel) {
        put(file, byte);
    }
}

std::string encode_older(const std::vector<Rgbe>& pixels)
{
    std::string file;
    for (std::size_t i = 0; i < pixels.size();) {
        const auto from = pixels.begin() + static_cast<std::ptrdiff_t>(i);
        const auto end =
            std::find_if(from, pixels.end(), [&](const Rgbe& p) { return p != *from; });
        auto repeats = static_cast<std::size_t>(end - from) - 1;
        put(file, *from);
        i += repeats + 1;
        for (; repeats > 0; repeats >>= 8U) {
            put(file, Rgbe{1, 1, 1, static_cast<std::uint8_t>(repeats & 255U)});
        }
    }
    return file;
}

std::string encode_newer(const std::vector<Rgbe>& pixels)
{
    std::string file{2, 2};
    put(file, pixels.size() >> 8U);
    put(file, pixels.size() & 255U);
    for (std::size_t c = 0; c < 4; ++c) {
        for (std::size_t i = 0; i < pixels.size();) {
            std::size_t count = 1;
            while (i + count < pixels.size() && count < 127 &&
                   pixels[i + count][c] == pixels[i][c]) {
                ++count;
            }
            if (count > 2) {
                put(file, 128 + count);
                put(file, pixels[i][c]);
            } else {
                // Up to 128 values one by one, some of which may be equal.
                count = std::min<std::size_t>(pixels.size() - i, 1 + i % 128);
                put(file, count);
                for (std::size_t j = i; j < i + count; ++j) {
                    put(file, pixels[j][c]);
                }
            }
            i += count;
        }
    }
    return file;
}

}  // namespace

std::string encode_scanline(const std::vector<Rgbe>& pixels, HdrEncoding encoding)
{
    if (encoding == HdrEncoding::newer) {
        return encode_newer(pixels);
    }
    if (encoding == HdrEncoding::older) {
        return encode_older(pixels);
    }
    std::string file;
    for (const Rgbe& pixel : pixels) {
        put(file, pixel);
    }
    return file;
}

std::string HdrFile::bytes() const
{
    std::string file = "#?RADIANCE\n" + lines + "FORMAT=32-bit_rle_rgbe\n\n" + resolution + "\n";
    for (auto from = pixels.begin(); from != pixels.end();) {
        const auto end = from + static_cast<std::ptrdiff_t>(inner);
        file += encode_scanline({from, end}, encoding);
        from = end;
    }
    return file;
}

std::vector<Rgbe> make_pixels(std::size_t count, std::size_t longest)
{
    std::uint32_t noise = 3;
    const auto next = [&noise](std::size_t end) {
        noise = noise * 1664525U + 1013904223U;
        return (noise >> 8U) % end;
    };
    std::vector<Rgbe> pixels;
    while (pixels.size() < count) {
        constexpr std::uint8_t exponents[] = {0, 1, 255, 128, 129, 136};
        Rgbe pixel{};
        for (std::uint8_t& mantissa : pixel) {
            mantissa = static_cast<std::uint8_t>(next(256));
        }
        pixel[next(3)] |= 128U;
        pixel[3] = exponents[next(std::size(exponents))];
        const std::size_t repeats = next(2) == 0 ? 1 : 1 + next(longest);
        pixels.insert(pixels.end(), std::min(repeats, count - pixels.size()), pixel);
    }
    return pixels;
}

HdrFile upright(int width, int height, const std::vector<Rgbe>& pixels, HdrEncoding encoding)
{
    return {.resolution = "-Y " + std::to_string(height) + " +X " + std::to_string(width),
            .inner = static_cast<std::size_t>(width),
            .pixels = pixels,
            .encoding = encoding};
}

}  // namespace bdpt::io
