#pragma once

#include "image/linear/image_readers.h"

#include <string>
#include <vector>

namespace bdpt::io {

enum class HdrEncoding {
    flat,
    older,  ///< a pixel and how often it is repeated
    newer,  ///< runs of each component by itself
};

/// A scanline in the format of Radiance HDR.
[[nodiscard]] std::string encode_scanline(const std::vector<Rgbe>& pixels, HdrEncoding encoding);

/// A Radiance HDR file. `lines` end with '\n' each and stand before that of the format; `pixels`
/// are a multiple of `inner`, the length of a scanline.
struct HdrFile {
    std::string lines{};
    std::string resolution{};
    std::size_t inner = 0;
    std::vector<Rgbe> pixels{};
    HdrEncoding encoding = HdrEncoding::flat;

    [[nodiscard]] std::string bytes() const;
};

/// Single pixels and runs of up to `longest` of the same; exponents of 0, 1 and 255 among them.
[[nodiscard]] std::vector<Rgbe> make_pixels(std::size_t count, std::size_t longest);

/// A file with these pixels that begins at the top left, as usual.
[[nodiscard]] HdrFile upright(int width, int height, const std::vector<Rgbe>& pixels,
                              HdrEncoding encoding);

}  // namespace bdpt::io
