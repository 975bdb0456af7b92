#pragma once

#include "light/environment/cell_tables.h"

#include <bdpt/render_options.h>
#include <bdpt/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace bdpt {

/// One number per tile of an environment.
struct TileFactors;

/// Sampling weights of an environment's cells.
struct EnvironmentWeights {
    int width = 0;  ///< [texels]
    int height = 0;
    /// Writes the weights of a row's cells, >= 0 and finite. Called twice for each row.
    std::function<void(int row, std::span<float> weights)> of_row;
    /// Fraction of the sphere's solid angle in each row. If empty, no weight is dim.
    std::vector<float> row_shares{};
};

/// Density of an environment's directions for a receiver: an equirectangular image in tiles; tiles
/// high above the receiver's surface are preferred, and those below are excluded
/// (docs/decisions/0060-environment-tiles.md). Normals are in the frame of the image.
///
/// Weights have two parts: the excess over half of their mean per solid angle, which is all that
/// compensated sampling uses, and the dim rest. Plain sampling uses both. Each bright cell has its
/// own density, dim cells share one for each of 16 x 16 parts of a tile
/// (docs/decisions/0070-compact-environments.md).
class EnvironmentTiles {
public:
    /// A cell, and a point in it. Cells are those of the weights; if these are so wide that all
    /// surfaces see a part of each, each weight is split into several adjacent cells.
    struct Sample {
        int column = 0;
        int row = 0;
        Vec2 offset{0.0f};  ///< position relative to the cell's corner, in [0, 1)^2 of its size
        float pdf = 0.0f;   ///< density on the unit square that the image fills
    };

    /// Half-open range of cells [begin, end).
    struct Range {
        std::uint32_t begin;
        std::uint32_t end;
        [[nodiscard]] std::uint32_t size() const { return end - begin; }
    };

    static constexpr std::uint32_t tile_columns = 16;
    static constexpr std::uint32_t max_rows = 8;
    static constexpr std::size_t tile_count = std::size_t{tile_columns} * max_rows;
    /// One number per tile, column-major; zero where there are fewer tiles.
    using PerTile = std::array<float, tile_count>;
    /// Unnormalized importance of the tiles to a receiver.
    struct Worth {
        alignas(16) PerTile of;
        std::array<float, max_rows> row_sums;
        float sum;

        using Pairs = std::array<float, tile_count / 2>;
        /// Computes the sums. `pairs` has those of tiles i and i + tile_count / 2.
        void sum_up(Pairs& pairs) noexcept;
    };

    /// Builds the distribution; if all weights are zero it cannot be sampled.
    explicit EnvironmentTiles(const EnvironmentWeights& weights);

    /// Returns the number of cells in a row.
    [[nodiscard]] int columns() const noexcept { return static_cast<int>(width_); }
    [[nodiscard]] int rows() const noexcept { return static_cast<int>(height_); }
    /// Samples a cell; nullopt if all weight is below the surface. Without a normal all weights
    /// count. `factors`, positive, multiply the weights of tiles; null: none. `sampling` is plain
    /// or not.
    [[nodiscard]] std::optional<Sample> sample(
        Vec2 u, const std::optional<Vec3>& normal, const TileFactors* factors = nullptr,
        EnvironmentSampling sampling = EnvironmentSampling::compensated) const noexcept;
    /// Returns the density with which `sample` chooses a point in this cell, on the unit square;
    /// zero if it never does.
    [[nodiscard]] float pdf(
        int column, int row, const std::optional<Vec3>& normal,
        const TileFactors* factors = nullptr,
        EnvironmentSampling sampling = EnvironmentSampling::compensated) const noexcept;
    /// Returns the weights of the tiles times `factors`, without a normal.
    [[nodiscard]] Worth worth(const TileFactors& factors,
                              EnvironmentSampling sampling) const noexcept;
    /// Samples a cell by these weights.
    [[nodiscard]] std::optional<Sample> sample(Vec2 u, const Worth& worth,
                                               EnvironmentSampling sampling) const noexcept;
    /// Returns the density of such a sample.
    [[nodiscard]] float pdf(int column, int row, const Worth& worth,
                            EnvironmentSampling sampling) const noexcept;
    /// Returns the tile that contains the cell, in [0, tile_count).
    [[nodiscard]] std::size_t find_tile(int column, int row) const noexcept;
    /// Returns the solid angle of a tile [sr].
    [[nodiscard]] double solid_angle(std::size_t tile) const noexcept;
    /// Returns the memory of the tables of cells [bytes].
    [[nodiscard]] std::size_t bytes() const noexcept { return cells_.bytes() + parts_.bytes(); }

private:
    void add_shape(std::size_t tile, Range columns, Range rows);
    /// Adds the `bright` and `dim` weights of a tile's cells.
    void add_tile(std::size_t tile, std::span<const float> bright, std::span<const float> dim,
                  double total);
    [[nodiscard]] Worth worth(const Worth& shares, const std::optional<Vec3>& normal,
                              const TileFactors* factors) const noexcept;
    /// Returns the density in the cell, in the tile's own unit square.
    [[nodiscard]] float pdf_in_tile(std::size_t tile, int column, int row,
                                    EnvironmentSampling sampling) const noexcept;
    [[nodiscard]] CellTables::Cell sample_cell(std::size_t tile, Vec2 u,
                                               EnvironmentSampling sampling) const noexcept;
    /// Tests whether samples in the tile may be of its dim weight.
    [[nodiscard]] bool samples_dim(std::size_t tile, EnvironmentSampling sampling) const noexcept
    {
        return sampling == EnvironmentSampling::plain && bright_in_tile_[tile] < 1.0f;
    }
    /// Returns the density of a bright cell of this probability in the tile's own unit square.
    [[nodiscard]] float bright_pdf(std::size_t tile, float probability) const noexcept
    {
        return probability *
               (static_cast<float>(count_columns(tile)) * static_cast<float>(count_rows(tile)));
    }
    [[nodiscard]] float density(std::size_t tile, const Worth& worth,
                                float cell_pdf) const noexcept;
    /// Returns the density in the tile's own unit square.
    [[nodiscard]] float cell_pdf(std::size_t tile, std::uint32_t column, std::uint32_t row,
                                 EnvironmentSampling sampling) const noexcept;
    [[nodiscard]] const Worth& shares(EnvironmentSampling sampling) const noexcept
    {
        return sampling == EnvironmentSampling::plain ? all_ : bright_;
    }
    // Numbers of cells in the tile.
    [[nodiscard]] std::uint32_t count_columns(std::size_t tile) const noexcept
    {
        return column_begins_[tile / max_rows + 1] - column_begins_[tile / max_rows];
    }
    [[nodiscard]] std::uint32_t count_rows(std::size_t tile) const noexcept
    {
        return row_begins_[tile % max_rows + 1] - row_begins_[tile % max_rows];
    }

    std::uint32_t cells_of_weight_;
    std::uint32_t width_;  // in cells
    std::uint32_t height_;
    std::uint32_t rows_;                                           // rows of tiles
    std::array<std::uint32_t, tile_columns + 1> column_begins_{};  // first cells of tiles
    std::array<std::uint32_t, max_rows + 1> row_begins_{};
    // Fraction of each tile in the sum of all weights.
    Worth all_;
    Worth bright_;
    PerTile bright_in_tile_{};                              // bright fraction of each tile's weight
    std::array<std::uint16_t, tile_count> grid_of_tile_{};  // index in the tables
    std::uint16_t grids_ = 0;
    // The importance of a tile is its share times n.axis + reach, if that is positive.
    alignas(16) PerTile axis_x_{};
    alignas(16) PerTile axis_y_{};
    alignas(16) PerTile axis_z_{};
    alignas(16) PerTile reach_{};
    PerTile tiles_in_image_{};  // area of the image over that of the tile
    CellTables cells_;          // bright weights
    CellTables parts_;          // dim weights
};

struct TileFactors {
    alignas(16) std::array<float, EnvironmentTiles::tile_count> of{};
};

}  // namespace bdpt
