#pragma once

/// @file
/// Marks a rectangle of pixels in an image.
///
/// @code{.cpp}
/// const bdpt::PixelRect face = {.x0 = 480, .y0 = 200, .x1 = 800, .y1 = 520};
/// const bdpt::RenderOptions options = {.film = {.width = 1280, .height = 720, .crop = face}};
/// @endcode

#include <cstddef>

namespace bdpt {

/// Half-open rectangle of pixels: columns [x0, x1), rows [y0, y1). Pixel (0, 0) is at the top left.
struct PixelRect {
    int x0 = 0;
    int y0 = 0;
    int x1 = 0;
    int y1 = 0;

    [[nodiscard]] int width() const { return x1 - x0; }
    [[nodiscard]] int height() const { return y1 - y0; }
    [[nodiscard]] bool contains(int x, int y) const
    {
        return x >= x0 && x < x1 && y >= y0 && y < y1;
    }
    /// Returns the number of pixels.
    [[nodiscard]] std::size_t area() const
    {
        return static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
    }
    /// Returns the number of pixels before one of these, row by row.
    [[nodiscard]] std::size_t index(int x, int y) const
    {
        return static_cast<std::size_t>(y - y0) * static_cast<std::size_t>(width()) +
               static_cast<std::size_t>(x - x0);
    }
    [[nodiscard]] bool operator==(const PixelRect&) const = default;
};

}  // namespace bdpt
