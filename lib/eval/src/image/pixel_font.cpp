#include "image/glyphs.h"

#include <bdpt/eval/drawing.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace bdpt::eval {
namespace {

constexpr std::uint8_t ink = 235;  // of 255, in each channel

void fill_square(io::DisplayImage& image, int x0, int y0, int side)
{
    for (int y = std::max(y0, 0); y < std::min(y0 + side, image.height); ++y) {
        for (int x = std::max(x0, 0); x < std::min(x0 + side, image.width); ++x) {
            const auto pixel = std::ptrdiff_t{y} * image.width + x;
            std::fill_n(image.rgb.begin() + 3 * pixel, 3, ink);
        }
    }
}

}  // namespace

io::DisplayImage with_text(io::DisplayImage image, std::string_view text, const TextPlace& place)
{
    int left = place.x;
    for (const char letter : text) {
        const Glyph& rows = glyph(letter);
        for (int row = 0; row < glyph_height; ++row) {
            for (int column = 0; column < glyph_width; ++column) {
                if (rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] == '#') {
                    fill_square(image, left + column * place.dot, place.y + row * place.dot,
                                place.dot);
                }
            }
        }
        left += glyph_advance * place.dot;
    }
    return image;
}

}  // namespace bdpt::eval
