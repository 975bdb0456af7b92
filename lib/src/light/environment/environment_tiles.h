#pragma once

#include "math/distribution_2d.h"

#include <bdpt/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace bdpt {

/// A number of each tile of an environment.
struct TileFactors;

/// Density of the directions of an environment for a receiver: an equirectangular image in tiles,
/// of which those come first that stand high above the receiver's surface, and those below never
/// (docs/decisions/0060-environment-tiles.md). Normals are in the frame of the image.
class EnvironmentTiles {
public:
    /// A cell, and a point in it. Cells are texels; those of a narrow image are so wide that all
    /// surfaces see some of each, so that each of them is several cells side by side.
    struct Sample {
        int column = 0;
        int row = 0;
        Vec2 offset{0.0f};  ///< from the cell's corner, in [0, 1)^2 of its size
        float pdf = 0.0f;   ///< on the unit square that the image fills
    };

    static constexpr std::size_t tile_count = 128;

    /// `weights` of texels, >= 0, row-major. Where all are zero there is nothing to sample.
    EnvironmentTiles(std::span<const float> weights, int width, int height);

    /// Of cells, in each row.
    [[nodiscard]] int columns() const noexcept { return static_cast<int>(width_); }
    /// Nothing where all that has weight is below the surface. Without a normal all weights count.
    /// `factors`, positive, multiply the weights of tiles; null: none.
    [[nodiscard]] std::optional<Sample> sample(Vec2 u, const std::optional<Vec3>& normal,
                                               const TileFactors* factors = nullptr) const noexcept;
    /// Of `sample` taking a point in this cell, on the unit square; zero if it never does.
    [[nodiscard]] float pdf(int column, int row, const std::optional<Vec3>& normal,
                            const TileFactors* factors = nullptr) const noexcept;
    /// The tile that the cell is in, in [0, tile_count).
    [[nodiscard]] std::size_t tile_of(int column, int row) const noexcept;

private:
    static constexpr std::uint32_t tile_columns = 16;
    static constexpr std::uint32_t most_rows = 8;
    /// A number of each tile, one column of tiles after the other; zero where there are fewer.
    using PerTile = std::array<float, tile_count>;
    static_assert(tile_columns * most_rows == tile_count);
    /// What tiles are worth to a receiver, in no unit.
    struct Worth {
        alignas(16) PerTile of;
        std::array<float, most_rows> row_sums;
        float sum;

        /// Sets the sums.
        void sum_up() noexcept;
    };
    /// The cells from `begin` on, before `end`.
    struct Range {
        std::uint32_t begin;
        std::uint32_t end;
        [[nodiscard]] std::uint32_t size() const { return end - begin; }
    };

    void add_tile(std::size_t tile, Range columns, Range rows, std::span<const float> weights,
                  double total);
    [[nodiscard]] Worth worth(const std::optional<Vec3>& normal,
                              const TileFactors* factors) const noexcept;
    [[nodiscard]] std::optional<Sample> sample(Vec2 u, const Worth& worth) const noexcept;
    [[nodiscard]] float density(std::size_t tile, const Worth& worth,
                                float cell_pdf) const noexcept;

    std::uint32_t cells_of_texel_;
    std::uint32_t width_;  // in cells
    std::uint32_t height_;
    std::uint32_t rows_;                                           // of tiles
    std::array<std::uint32_t, tile_columns + 1> column_begins_{};  // first cells of tiles
    std::array<std::uint32_t, most_rows + 1> row_begins_{};
    Worth all_;  // the share of each tile in all weights
    // A tile is worth its share times n.axis + reach, if that is positive.
    alignas(16) PerTile axis_x_{};
    alignas(16) PerTile axis_y_{};
    alignas(16) PerTile axis_z_{};
    alignas(16) PerTile reach_{};
    PerTile tiles_in_image_{};  // area of the image over that of the tile
    std::vector<Distribution2D> cells_;
};

struct TileFactors {
    alignas(16) std::array<float, EnvironmentTiles::tile_count> of{};
};

}  // namespace bdpt
