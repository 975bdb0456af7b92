#pragma once

#include "light/environment/environment_texels.h"

#include <bdpt/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace bdpt {

/// Sampling weights of an environment's cells: luminance of texels and their neighbours, as
/// bilinear lookups spread light over the edge, times solid angle (up to a constant). Cells are
/// texels, or several texels in large images: detail finer than a fifth of a degree does not affect
/// noise, but larger tables cost each sample memory latency.
class CellWeights {
public:
    /// `row_shares` is the fraction of the sphere in each row of texels.
    CellWeights(const EnvironmentTexels& texels, std::vector<float> row_shares);

    [[nodiscard]] int columns() const { return columns_; }
    [[nodiscard]] int rows() const { return rows_; }
    /// Writes the weights of a row of cells, at most 12. If called for one row after the other, it
    /// reads each texel once.
    void of_row(int row, std::span<float> weights);

private:
    struct Row {
        int y = -1;
        std::vector<float> luminances{};
    };

    [[nodiscard]] const std::vector<float>& luminances(int y);
    void add_texels(int y, float share);

    const EnvironmentTexels& texels_;
    std::vector<float> row_shares_;
    int columns_;
    int rows_;
    float scale_;
    std::array<Row, 4> cached_{};
    std::vector<float> sums_;    // sums of three vertically adjacent texels
    std::vector<float> of_row_;  // weights of texels
};

/// Discrete distributions on grids of cells, the tiles of an environment, with 16 bits per cell.
/// Sampling inverts cumulative sums, so it preserves the stratification of its random numbers; a
/// short guide table gives the starting point in a row (Chen and Asau 1974). Sums are integers: a
/// cell with weight has at least one of the 65408 parts of its row, a row with weight one of 2^24
/// of its grid; without weight they have none. A probability within a row differs from that of the
/// weights by at most n / 65408 for n cells.
class CellTables {
public:
    /// A cell, and a point in it.
    struct Cell {
        std::uint32_t column = 0;
        std::uint32_t row = 0;
        Vec2 offset{0.0f};  ///< position relative to the cell's corner, in [0, 1)^2 of its size
        float probability = 0.0f;  ///< of the cell
    };

    /// Reserves memory for grids with that total number of cells, so that adding them copies none.
    void reserve(std::size_t cells, std::size_t rows);
    /// Adds a grid of at most 32768 columns; `weights`, >= 0 and finite, row-major. If all are zero
    /// it cannot be sampled.
    void add(std::span<const float> weights, std::size_t columns);

    /// Samples a cell of grid number `grid`, which has weight.
    [[nodiscard]] Cell sample(std::size_t grid, Vec2 u) const noexcept;
    /// Returns the probability with which `sample` chooses this cell.
    [[nodiscard]] float probability(std::size_t grid, std::uint32_t column,
                                    std::uint32_t row) const noexcept;
    /// Returns the memory of the tables [bytes].
    [[nodiscard]] std::size_t bytes() const noexcept;

private:
    struct Grid {
        std::size_t cells = 0;  // start of its sums in `cells_`
        std::size_t rows = 0;   // start of its sums in `rows_`
        std::uint32_t columns = 0;
        std::uint32_t row_count = 0;
    };
    [[nodiscard]] const std::uint16_t* steps_of_row(const Grid& grid,
                                                    std::uint32_t row) const noexcept;

    std::vector<Grid> grids_;
    // For each row of numbers a guide table, followed by the exclusive prefix sums.
    std::vector<std::uint16_t> cells_;
    std::vector<std::uint32_t> rows_;
};

}  // namespace bdpt
