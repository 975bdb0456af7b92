#include "compare/tiles.h"

#include <algorithm>
#include <cstddef>

namespace bdpt::eval {

std::vector<PixelRect> make_tiles(int width, int height, int size)
{
    // Larger tiles are equivalent, but sums could overflow.
    const int side = std::min(size, std::max(width, height));
    std::vector<PixelRect> tiles;
    for (int y = 0; y < height; y += side) {
        for (int x = 0; x < width; x += side) {
            tiles.push_back({.x0 = x,
                             .y0 = y,
                             .x1 = std::min(x + side, width),
                             .y1 = std::min(y + side, height)});
        }
    }
    return tiles;
}

double tile_mean(std::span<const double> values, int width, const PixelRect& tile)
{
    double sum = 0.0;
    for (int y = tile.y0; y < tile.y1; ++y) {
        for (int x = tile.x0; x < tile.x1; ++x) {
            sum += values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                          static_cast<std::size_t>(x)];
        }
    }
    return sum / (static_cast<double>(tile.width()) * static_cast<double>(tile.height()));
}

}  // namespace bdpt::eval
