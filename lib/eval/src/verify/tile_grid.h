#pragma once

#include <bdpt/pixel_rect.h>
#include <bdpt/types.h>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace bdpt::eval {

/// An image divided into `grid` x `grid` tiles of about equal size.
class TileGrid {
public:
    /// `grid` is at most the shorter side.
    TileGrid(int width, int height, int grid) : width_(width), height_(height), grid_(grid)
    {
        for (int row = 0; row < grid; ++row) {
            for (int column = 0; column < grid; ++column) {
                tiles_.push_back({.x0 = begin(column, width),
                                  .y0 = begin(row, height),
                                  .x1 = begin(column + 1, width),
                                  .y1 = begin(row + 1, height)});
            }
        }
    }

    /// Returns the tiles, row by row.
    [[nodiscard]] const std::vector<PixelRect>& tiles() const { return tiles_; }
    [[nodiscard]] std::size_t size() const { return tiles_.size(); }
    [[nodiscard]] double pixels() const
    {
        return static_cast<double>(width_) * static_cast<double>(height_);
    }
    [[nodiscard]] double pixels(std::size_t tile) const
    {
        return static_cast<double>(tiles_[tile].width()) *
               static_cast<double>(tiles_[tile].height());
    }

    /// Returns the tile of the pixel that holds `raster`, which is in the image.
    [[nodiscard]] std::size_t tile_at(Vec2 raster) const
    {
        return static_cast<std::size_t>(place(raster.y, height_) * grid_ + place(raster.x, width_));
    }

private:
    [[nodiscard]] int begin(int tile, int size) const
    {
        return static_cast<int>((static_cast<long long>(tile) * size + grid_ - 1) / grid_);
    }
    [[nodiscard]] int place(float raster, int size) const
    {
        const int pixel = std::clamp(static_cast<int>(raster), 0, size - 1);
        return static_cast<int>(static_cast<long long>(pixel) * grid_ / size);
    }

    int width_;
    int height_;
    int grid_;
    std::vector<PixelRect> tiles_;
};

}  // namespace bdpt::eval
