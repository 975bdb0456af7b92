#pragma once

#include "file/bytes.h"

#include <array>
#include <cstddef>
#include <string>

namespace bdpt::io {

/// One of the two axes that the pixels of a Radiance HDR image are stored along.
struct HdrAxis {
    char name = 'X';      ///< X, which points to the right, or Y, which points up
    bool ascends = true;  ///< true: pixels follow each other along the axis; false: against it
    int size = 0;         ///< [pixels], at least 1
};

/// Header of a Radiance HDR image.
struct HdrHeader {
    HdrAxis outer;  ///< from scanline to scanline
    HdrAxis inner;  ///< within a scanline
    /// Factors that red, green and blue have been multiplied by: the product of all EXPOSURE and
    /// COLORCORR lines. Finite and positive.
    std::array<double, 3> exposure{1.0, 1.0, 1.0};
    std::size_t size = 0;  ///< [bytes]

    [[nodiscard]] int width() const { return outer.name == 'X' ? outer.size : inner.size; }
    [[nodiscard]] int height() const { return outer.name == 'Y' ? outer.size : inner.size; }
};

/// Reads the header [Ward, "The RADIANCE Picture File Format", in the Radiance Reference Manual].
/// Lines that change no pixel are ignored, PRIMARIES and GAMMA among them. Throws `Error`:
/// invalid_input (broken), unsupported (pixels other than 32-bit_rle_rgbe).
[[nodiscard]] HdrHeader read_hdr_header(ByteView file);

/// Throws an `Error` (invalid_input) about a Radiance HDR image.
[[noreturn]] void fail_hdr(const std::string& what);

}  // namespace bdpt::io
