#pragma once

#include "file/bytes.h"

#include <cstdint>
#include <string>
#include <vector>

namespace bdpt::io {

/// Colour encoding that the image states; glTF uses the encoding of the texture's purpose.
enum class ColorEncoding : std::uint8_t { unknown, linear, srgb };

/// Header of a KTX2 image that a texture may have [KTX File Format Specification 2.0;
/// KHR_texture_basisu]: 2D, ETC1S, UASTC, or 8-bit RGB or RGBA.
struct Ktx2Header {
    int width = 0;     ///< >= 1
    int height = 0;    ///< >= 1
    int channels = 0;  ///< 3: RGB, 4: RGBA
    ColorEncoding encoding = ColorEncoding::unknown;
    std::uint64_t pixels = 0;  ///< sum over all levels
    /// Violations of KHR_texture_basisu that do not prevent decoding.
    std::vector<std::string> remarks;
};

/// Tests whether a file begins like KTX files of some version.
[[nodiscard]] bool is_ktx(ByteView bytes);

/// Checks all offsets and sizes before a library sees the file. Throws std::runtime_error if the
/// file is broken, or is no image that a texture may have.
[[nodiscard]] Ktx2Header read_ktx2_header(ByteView bytes);

}  // namespace bdpt::io
