#pragma once

#include <bdpt/types.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace bdpt {

/// Densities on grids of cells, in 16 bits for each cell: the tiles of an environment. Sampling
/// inverts cumulative sums, so it keeps the stratification of its random numbers; a short guide
/// says where in a row to look (Chen and Asau 1974). Sums are whole numbers: a cell with weight has
/// at least one of the 65408 parts of its row, a row with weight one of 2^24 of its grid, and
/// without weight there is none. A probability within a row differs from that of the weights by at
/// most n / 65408 for n cells.
class CellTables {
public:
    /// A cell, and a point in it.
    struct Cell {
        std::uint32_t column = 0;
        std::uint32_t row = 0;
        Vec2 offset{0.0f};  ///< from the cell's corner, in [0, 1)^2 of its size
    };

    /// Makes room for grids with so many cells in all, so that adding them copies none.
    void reserve(std::size_t cells, std::size_t rows);
    /// Adds a grid of at most 32768 columns; `weights`, >= 0 and finite, row-major. Where all are
    /// zero there is nothing to sample.
    void add(std::span<const float> weights, std::size_t columns);

    /// Of a grid with weight, by its number.
    [[nodiscard]] Cell sample(std::size_t grid, Vec2 u) const noexcept;
    /// Of `sample` taking this cell.
    [[nodiscard]] float probability(std::size_t grid, std::uint32_t column,
                                    std::uint32_t row) const noexcept;
    /// What the tables take.
    [[nodiscard]] std::size_t bytes() const noexcept;

private:
    struct Grid {
        std::size_t cells = 0;  // where its steps begin in `cells_`
        std::size_t rows = 0;   // and in `rows_`
        std::uint32_t columns = 0;
        std::uint32_t row_count = 0;
    };
    [[nodiscard]] const std::uint16_t* steps_of_row(const Grid& grid,
                                                    std::uint32_t row) const noexcept;

    std::vector<Grid> grids_;
    // Of each row of numbers a guide, and then the sum before each number.
    std::vector<std::uint16_t> cells_;
    std::vector<std::uint32_t> rows_;
};

}  // namespace bdpt
