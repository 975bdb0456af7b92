#pragma once

#include <bdpt/pixel_rect.h>

#include <span>
#include <vector>

namespace bdpt::eval {

/// Returns tiles of `size` x `size` pixels that cover the image, row by row; those at the right and
/// the lower border are cut.
[[nodiscard]] std::vector<PixelRect> make_tiles(int width, int height, int size);

/// Returns the mean over `tile` of per-pixel values, in rows of `width`.
[[nodiscard]] double tile_mean(std::span<const double> values, int width, const PixelRect& tile);

}  // namespace bdpt::eval
