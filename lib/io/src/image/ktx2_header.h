#pragma once

#include "file/bytes.h"

#include <cstdint>
#include <string>
#include <vector>

namespace bdpt::io {

/// How the colours of an image are encoded, as the image says; glTF goes by what a texture is for.
enum class ColorEncoding : std::uint8_t { unknown, linear, srgb };

/// What the header of a KTX2 image says that a texture may have [KTX File Format Specification 2.0;
/// KHR_texture_basisu]: 2D, ETC1S, UASTC, or 8-bit RGB or RGBA.
struct Ktx2Header {
    int width = 0;     ///< >= 1
    int height = 0;    ///< >= 1
    int channels = 0;  ///< 3: RGB, 4: RGBA
    ColorEncoding encoding = ColorEncoding::unknown;
    std::uint64_t pixels = 0;  ///< of all levels
    /// What KHR_texture_basisu does not allow, though the image can be decoded.
    std::vector<std::string> remarks;
};

/// Whether a file begins as KTX files of some version do.
[[nodiscard]] bool is_ktx(ByteView bytes);

/// Checks all that says where something lies and how large it is, before a library sees the file.
/// Throws std::runtime_error where the file is broken, or no image that a texture may have.
[[nodiscard]] Ktx2Header read_ktx2_header(ByteView bytes);

}  // namespace bdpt::io
