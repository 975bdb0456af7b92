#include "light/environment/environment_tiles.h"

#include "math/elementary.h"

#include <algorithm>
#include <cmath>

namespace bdpt {
namespace {

/// Part `i` of `count` among `size` things; none is empty if there are no more parts than things.
std::uint32_t begin_of_part(std::uint32_t i, std::uint32_t count, std::uint32_t size)
{
    return static_cast<std::uint32_t>(std::uint64_t{size} * i / count);
}

/// The part that `thing` is in.
std::uint32_t part_of(std::uint32_t thing, std::uint32_t count, std::uint32_t size)
{
    return static_cast<std::uint32_t>(((std::uint64_t{thing} + 1) * count - 1) / size);
}

/// Of the directions of a tile: no normal whose n.axis + reach is zero or less sees any of them.
struct TileCone {
    Vec3 axis{0.0f};
    float reach = 1.0f;
};

/// Of a block of the unit square that the image fills. A surface sees a direction of a cone with
/// half angle theta if its normal is less than 90 degrees + theta away from the axis, which is
/// n.axis > -sin(theta). A wide cone does not tell how high above the surface its light is, so it
/// has no axis, and counts the same for all normals.
TileCone cone_around(Vec2 begin, Vec2 end)
{
    constexpr float least_cosine = 0.5f;
    constexpr float rounding = 1e-3f;
    const SinCos phi = sin_cos(pi * (begin.x + end.x - 1.0f));
    const SinCos theta = sin_cos(0.5f * pi * (begin.y + end.y));
    // Farthest from the middle are corners, or points between them that are past 90 degrees.
    const float cos_half_width = sin_cos(pi * (end.x - begin.x)).cos;
    float cosine = 1.0f;
    for (const float v : {begin.y, end.y}) {
        const SinCos edge = sin_cos(pi * v);
        cosine = std::min(cosine, theta.cos * edge.cos + theta.sin * edge.sin * cos_half_width);
    }
    if (cosine < least_cosine) {
        return {};
    }
    return {.axis = {theta.sin * phi.sin, theta.cos, -theta.sin * phi.cos},
            .reach = std::sqrt(1.0f - std::min(cosine * cosine, 1.0f)) + rounding};
}

/// Adds the second half of 2 `Count` numbers to the first. No sum waits for another one, and
/// vectors of any width add in the same order.
template <std::size_t Count>
void fold(float* numbers)
{
    for (std::size_t i = 0; i < Count; ++i) {
        numbers[i] += numbers[i + Count];
    }
}

struct Pick {
    std::size_t index = 0;
    float u = 0.0f;  ///< uniform again
};

/// One of `count` numbers, in proportion to them; each is `Stride` after the one before it. `sum`,
/// of all of them, is positive.
template <std::size_t Stride>
Pick pick(const float* numbers, std::size_t count, float sum, float u)
{
    constexpr float below_one = 0x1.fffffep-1f;
    Pick picked;
    float left = u * sum;
    float before = left;
    float number = 0.0f;
    for (std::size_t i = 0; i < count; ++i) {
        if (!(numbers[i * Stride] > 0.0f)) {
            continue;
        }
        number = numbers[i * Stride];
        picked.index = i;
        before = left;
        left -= number;
        if (left < 0.0f) {
            break;
        }
    }
    picked.u = std::min(before / number, below_one);
    return picked;
}

}  // namespace

EnvironmentTiles::EnvironmentTiles(std::span<const float> weights, int width, int height)
    : cells_of_texel_((tile_columns - 1) / static_cast<std::uint32_t>(width) + 1),
      width_(static_cast<std::uint32_t>(width) * cells_of_texel_),
      height_(static_cast<std::uint32_t>(height)),
      rows_(std::min(height_, most_rows)),
      all_{}
{
    double total = 0.0;
    for (const float weight : weights) {
        total += static_cast<double>(weight);
    }
    for (std::uint32_t i = 0; i <= tile_columns; ++i) {
        column_begins_[i] = begin_of_part(i, tile_columns, width_);
    }
    for (std::uint32_t j = 0; j <= rows_; ++j) {
        row_begins_[j] = begin_of_part(j, rows_, height_);
    }
    cells_.reserve(std::size_t{tile_columns} * rows_);
    for (std::uint32_t i = 0; i < tile_columns; ++i) {
        for (std::uint32_t j = 0; j < rows_; ++j) {
            add_tile(i * most_rows + j, {column_begins_[i], column_begins_[i + 1]},
                     {row_begins_[j], row_begins_[j + 1]}, weights, total);
        }
    }
    all_.sum_up();
}

void EnvironmentTiles::add_tile(std::size_t tile, Range columns, Range rows,
                                std::span<const float> weights, double total)
{
    const std::uint32_t texels = width_ / cells_of_texel_;
    std::vector<float> own;
    own.reserve(std::size_t{columns.size()} * rows.size());
    double sum = 0.0;
    for (std::uint32_t y = rows.begin; y < rows.end; ++y) {
        for (std::uint32_t x = columns.begin; x < columns.end; ++x) {
            own.push_back(weights[std::size_t{y} * texels + x / cells_of_texel_]);
            sum += static_cast<double>(own.back());
        }
    }
    cells_.emplace_back(own, static_cast<int>(columns.size()), static_cast<int>(rows.size()));
    all_.of[tile] = total > 0.0
                        ? static_cast<float>(sum / (total * static_cast<double>(cells_of_texel_)))
                        : 0.0f;
    const Vec2 size(width_, height_);
    const TileCone cone =
        cone_around(Vec2(columns.begin, rows.begin) / size, Vec2(columns.end, rows.end) / size);
    axis_x_[tile] = cone.axis.x;
    axis_y_[tile] = cone.axis.y;
    axis_z_[tile] = cone.axis.z;
    reach_[tile] = cone.reach;
    tiles_in_image_[tile] =
        size.x * size.y / (static_cast<float>(columns.size()) * static_cast<float>(rows.size()));
}

void EnvironmentTiles::Worth::sum_up() noexcept
{
    static_assert(tile_columns == 16 && most_rows == 8);
    alignas(16) std::array<float, 64> sums;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        sums[i] = of[i] + of[i + sums.size()];
    }
    fold<32>(sums.data());
    fold<16>(sums.data());
    fold<8>(sums.data());
    std::copy_n(sums.begin(), most_rows, row_sums.begin());
    fold<4>(sums.data());
    sum = (sums[0] + sums[2]) + (sums[1] + sums[3]);
}

EnvironmentTiles::Worth EnvironmentTiles::worth(const std::optional<Vec3>& normal,
                                                const TileFactors* factors) const noexcept
{
    Worth result;
    if (normal) {
        for (std::size_t tile = 0; tile < result.of.size(); ++tile) {
            const float height = normal->x * axis_x_[tile] + normal->y * axis_y_[tile] +
                                 normal->z * axis_z_[tile] + reach_[tile];
            result.of[tile] = (height > 0.0f ? height : 0.0f) * all_.of[tile];
        }
    } else {
        result.of = all_.of;
    }
    if (factors != nullptr) {
        for (std::size_t tile = 0; tile < result.of.size(); ++tile) {
            result.of[tile] *= factors->of[tile];
        }
    }
    result.sum_up();
    return result;
}

float EnvironmentTiles::density(std::size_t tile, const Worth& worth, float cell_pdf) const noexcept
{
    return worth.of[tile] / worth.sum * (cell_pdf * tiles_in_image_[tile]);
}

std::optional<EnvironmentTiles::Sample> EnvironmentTiles::sample(Vec2 u,
                                                                 const Worth& worth) const noexcept
{
    if (!(worth.sum > 0.0f)) {
        return std::nullopt;
    }
    const Pick row = pick<1>(worth.row_sums.data(), rows_, worth.sum, u.y);
    const Pick column =
        pick<most_rows>(&worth.of[row.index], tile_columns, worth.row_sums[row.index], u.x);
    const std::size_t tile = column.index * most_rows + row.index;
    const Distribution2D::Cell cell =
        cells_[column.index * rows_ + row.index].sample_cell({column.u, row.u});
    const float pdf = density(tile, worth, cell.pdf);
    if (!(pdf > 0.0f)) {
        return std::nullopt;
    }
    return Sample{.column = static_cast<int>(column_begins_[column.index]) + cell.column,
                  .row = static_cast<int>(row_begins_[row.index]) + cell.row,
                  .offset = cell.offset,
                  .pdf = pdf};
}

std::optional<EnvironmentTiles::Sample> EnvironmentTiles::sample(
    Vec2 u, const std::optional<Vec3>& normal, const TileFactors* factors) const noexcept
{
    return normal || factors != nullptr ? sample(u, worth(normal, factors)) : sample(u, all_);
}

std::size_t EnvironmentTiles::tile_of(int column, int row) const noexcept
{
    return part_of(static_cast<std::uint32_t>(column), tile_columns, width_) * most_rows +
           part_of(static_cast<std::uint32_t>(row), rows_, height_);
}

float EnvironmentTiles::pdf(int column, int row, const std::optional<Vec3>& normal,
                            const TileFactors* factors) const noexcept
{
    const auto x = static_cast<std::uint32_t>(column);
    const auto y = static_cast<std::uint32_t>(row);
    const std::uint32_t i = part_of(x, tile_columns, width_);
    const std::uint32_t j = part_of(y, rows_, height_);
    const std::size_t tile = i * most_rows + j;
    if (!(all_.of[tile] > 0.0f)) {
        return 0.0f;
    }
    const float cell_pdf = cells_[i * rows_ + j].cell_pdf(static_cast<int>(x - column_begins_[i]),
                                                          static_cast<int>(y - row_begins_[j]));
    if ((!normal && factors == nullptr) || !(cell_pdf > 0.0f)) {
        return density(tile, all_, cell_pdf);
    }
    const Worth seen = worth(normal, factors);
    return seen.of[tile] > 0.0f ? density(tile, seen, cell_pdf) : 0.0f;
}

}  // namespace bdpt
