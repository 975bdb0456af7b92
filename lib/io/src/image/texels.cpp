#include "image/texels.h"

#include "image/oiio_library.h"

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>

namespace bdpt::io {

namespace {

bool has(ByteView bytes, std::size_t offset, std::string_view text)
{
    return bytes.size() >= offset + text.size() &&
           std::equal(text.begin(), text.end(), bytes.begin() + static_cast<std::ptrdiff_t>(offset),
                      [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

const char* find_format(ByteView bytes)
{
    if (has(bytes, 0, "\x89PNG\r\n\x1a\n")) {
        return "png";
    }
    if (has(bytes, 0, "\xff\xd8\xff")) {
        return "jpeg";
    }
    if (has(bytes, 0, "RIFF") && has(bytes, 8, "WEBP")) {
        return "webp";
    }
    if (has(bytes, 0, "\xabKTX")) {
        throw std::runtime_error("KTX pictures are not supported");
    }
    throw std::runtime_error("neither PNG, JPEG nor WebP");
}

/// The channel of `raw` that gives channel `c` (0 to 3) of the result; -1: none.
int source_channel(const RawPicture<std::uint8_t>& raw, int c)
{
    if (c == 3) {
        // Two and four channels have alpha last, whether the decoder says so or not.
        return raw.channels == 2 || raw.channels >= 4 ? (raw.channels == 2 ? 1 : 3) : -1;
    }
    return raw.channels < 3 ? 0 : c;
}

}  // namespace

TexelImage decode_texels(ByteView bytes, const ReadLimits& limits)
{
    const char* format = find_format(bytes);
    const RawPicture<std::uint8_t> raw = OiioLibrary().decode<std::uint8_t>(format, bytes, limits);
    TexelImage image{raw.width, raw.height, {}};
    const std::size_t pixels =
        static_cast<std::size_t>(raw.width) * static_cast<std::size_t>(raw.height);
    const auto channels = static_cast<std::size_t>(raw.channels);
    image.rgba.resize(4 * pixels);
    for (int c = 0; c < 4; ++c) {
        const int source = source_channel(raw, c);
        for (std::size_t i = 0; i < pixels; ++i) {
            image.rgba[4 * i + static_cast<std::size_t>(c)] =
                source < 0 ? std::uint8_t{255}
                           : raw.values[channels * i + static_cast<std::size_t>(source)];
        }
    }
    return image;
}

}  // namespace bdpt::io
