#pragma once

#include <bdpt/pixel_rect.h>

#include <span>
#include <vector>

namespace bdpt::eval {

/// Squares of `size` pixels a side that cover the image, in rows; those at the right and the
/// lower border are cut.
[[nodiscard]] std::vector<PixelRect> make_tiles(int width, int height, int size);

/// The mean over `tile` of a number a pixel, in rows of `width`.
[[nodiscard]] double tile_mean(std::span<const double> values, int width, const PixelRect& tile);

}  // namespace bdpt::eval
