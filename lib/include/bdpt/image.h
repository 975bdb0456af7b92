#pragma once

#include <bdpt/types.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt {

/// Row-major linear RGB pixels; row 0 is the top row.
struct Image {
    int width = 0;
    int height = 0;
    std::vector<Rgb> pixels;  ///< width * height

    /// `x` in [0, width), `y` in [0, height).
    [[nodiscard]] const Rgb& at(int x, int y) const
    {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)];
    }
};

/// Row-major 8-bit RGBA texels as they are stored in a picture file; row 0 is the top row. Which
/// channels are sRGB-encoded is decided by the material slot that refers to the picture.
struct TexelImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> rgba;  ///< 4 * width * height
};

}  // namespace bdpt
