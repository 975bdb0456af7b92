#pragma once

#include "integrator/integrator.h"
#include "math/random_numbers.h"

#include <bdpt/types.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt {

/// A grid of cells over the whole image; a pilot samples one pixel of each cell.
class PilotGrid {
public:
    PilotGrid(int width, int height) : width_(width), height_(height)
    {
        const double pixels = static_cast<double>(width) * static_cast<double>(height);
        const double cells =
            std::clamp(share_of_pixels * pixels, std::min(min_cells, pixels), max_cells);
        const double side = std::sqrt(pixels / cells);
        columns_ = std::clamp(static_cast<int>(std::lround(width / side)), 1, width);
        rows_ = std::clamp(static_cast<int>(std::lround(height / side)), 1, height);
    }
    [[nodiscard]] int columns() const { return columns_; }
    [[nodiscard]] int rows() const { return rows_; }
    /// Returns the number of pixels of the image.
    [[nodiscard]] double pixels() const
    {
        return static_cast<double>(width_) * static_cast<double>(height_);
    }
    [[nodiscard]] int width() const { return width_; }    ///< of the image [pixels]
    [[nodiscard]] int height() const { return height_; }  ///< of the image [pixels]
    [[nodiscard]] std::size_t cells() const { return index(0, rows_); }
    [[nodiscard]] std::size_t index(int column, int row) const
    {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
               static_cast<std::size_t>(column);
    }
    /// Returns the cell at `raster`.
    [[nodiscard]] std::size_t cell_at(Vec2 raster) const
    {
        return index(cell(raster.x, columns_, width_), cell(raster.y, rows_, height_));
    }
    /// Returns the column of cells of each column of pixels.
    [[nodiscard]] std::vector<int> columns_of_pixels() const { return spread(columns_, width_); }
    /// Returns the row of cells of each row of pixels.
    [[nodiscard]] std::vector<int> rows_of_pixels() const { return spread(rows_, height_); }
    /// Returns the pixel of a cell, at a random position in it.
    [[nodiscard]] Tile pixel(int column, int row) const
    {
        const std::uint64_t random = split_mix(golden_ratio_64 * (index(column, row) + 1));
        const int x = place(column, columns_, width_, static_cast<std::uint32_t>(random));
        const int y = place(row, rows_, height_, static_cast<std::uint32_t>(random >> 32U));
        return {.x_begin = x, .x_end = x + 1, .y_begin = y, .y_end = y + 1};
    }

private:
    static constexpr double share_of_pixels = 1.0 / 8.0;
    static constexpr double min_cells = 512.0;
    static constexpr double max_cells = 8192.0;

    static int place(int cell, int cells, int pixels, std::uint32_t random)
    {
        const double at = (cell + static_cast<double>(random) * 0x1p-32) * pixels / cells;
        return std::min(static_cast<int>(at), pixels - 1);
    }
    static int cell(float raster, int cells, int pixels)
    {
        return std::clamp(static_cast<int>(static_cast<double>(raster) * cells / pixels), 0,
                          cells - 1);
    }

    static std::vector<int> spread(int cells, int pixels)
    {
        std::vector<int> result;
        result.reserve(static_cast<std::size_t>(pixels));
        for (int i = 0; i < pixels; ++i) {
            result.push_back(cell(static_cast<float>(i) + 0.5f, cells, pixels));
        }
        return result;
    }

    int width_;
    int height_;
    int columns_;
    int rows_;
};

}  // namespace bdpt
