#include "image/webp_header.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string_view>

namespace bdpt::io {

namespace {

constexpr std::size_t chunk_at = 12;                 // of the first chunk
constexpr std::size_t payload_at = chunk_at + 8;     // after its name and length
constexpr std::size_t header_end = payload_at + 10;  // of the longest kind

bool has(ByteView file, std::size_t offset, std::string_view text)
{
    return file.size() >= offset + text.size() &&
           std::equal(text.begin(), text.end(), file.begin() + static_cast<std::ptrdiff_t>(offset),
                      [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

/// Little-endian.
std::uint32_t number(ByteView file, std::size_t offset, std::size_t bytes)
{
    std::uint32_t value = 0;
    for (std::size_t i = bytes; i-- > 0;) {
        value = value << 8U | file[offset + i];
    }
    return value;
}

EncodedImageSize size_of(std::uint32_t width, std::uint32_t height)
{
    return {static_cast<int>(width), static_cast<int>(height)};
}

}  // namespace

bool is_webp(ByteView file)
{
    return has(file, 0, "RIFF") && has(file, 8, "WEBP");
}

EncodedImageSize webp_size(ByteView file)
{
    constexpr std::uint32_t fourteen_bits = 0x3fff;
    if (file.size() < header_end) {
        throw std::runtime_error("the WebP header is cut off");
    }
    if (has(file, chunk_at, "VP8X")) {
        return size_of(number(file, payload_at + 4, 3) + 1, number(file, payload_at + 7, 3) + 1);
    }
    if (has(file, chunk_at, "VP8L") && file[payload_at] == 0x2f) {
        const std::uint32_t bits = number(file, payload_at + 1, 4);
        return size_of((bits & fourteen_bits) + 1, (bits >> 14U & fourteen_bits) + 1);
    }
    if (has(file, chunk_at, "VP8 ") && has(file, payload_at + 3, "\x9d\x01\x2a")) {
        return size_of(number(file, payload_at + 6, 2) & fourteen_bits,
                       number(file, payload_at + 8, 2) & fourteen_bits);
    }
    throw std::runtime_error("the WebP header is broken");
}

}  // namespace bdpt::io
