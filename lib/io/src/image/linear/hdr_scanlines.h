#pragma once

#include "file/bytes.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace bdpt::io {

/// Mantissas of red, green and blue and their exponent e: values are mantissa * 2^(e - 136), and 0
/// where e is 0 [Ward, "Real Pixels", Graphics Gems II, 1991, sec. II.5].
using Rgbe = std::array<std::uint8_t, 4>;

/// The scanlines of a Radiance HDR image, one after the other. Each is flat, or run-length encoded
/// in the older or the newer way [Ward, "The RADIANCE Picture File Format"].
class HdrScanlines {
public:
    /// `encoded` is the data behind the header; it must outlive this object.
    explicit HdrScanlines(ByteView encoded) : rest_(encoded) {}

    /// Reads the next scanline. Throws `Error` (invalid_input) that names the scanline if it is
    /// broken or truncated.
    void read(std::span<Rgbe> line);

private:
    [[nodiscard]] std::uint8_t take();
    [[nodiscard]] Rgbe take_pixel();
    void read_by_pixels(std::span<Rgbe> line);
    void read_by_components(std::span<Rgbe> line);
    void read_component(std::span<Rgbe> line, std::size_t component);
    [[noreturn]] void fail(const char* what) const;

    ByteView rest_;
    std::size_t number_ = 0;  // number of the scanline, from 1
};

}  // namespace bdpt::io
