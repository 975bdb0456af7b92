#include "light/environment/environment_tiles.h"

#include "math/elementary.h"

#include <algorithm>
#include <cmath>

namespace bdpt {
namespace {

constexpr float below_one = 0x1.fffffep-1f;

/// Returns the begin of part `i` of `count` among `size` items; none is empty if there are at most
/// `size` parts.
std::uint32_t begin_of_part(std::uint32_t i, std::uint32_t count, std::uint32_t size)
{
    return static_cast<std::uint32_t>(std::uint64_t{size} * i / count);
}

/// Returns part `i`.
EnvironmentTiles::Range part(std::uint32_t i, std::uint32_t count, std::uint32_t size)
{
    return {begin_of_part(i, count, size), begin_of_part(i + 1, count, size)};
}

/// Returns the part that contains `thing`.
std::uint32_t find_part(std::uint32_t thing, std::uint32_t count, std::uint32_t size)
{
    return static_cast<std::uint32_t>(((std::uint64_t{thing} + 1) * count - 1) / size);
}

/// Cone of the directions of a tile: a surface whose n.axis + reach is zero or less sees none of
/// them.
struct TileCone {
    Vec3 axis{0.0f};
    float reach = 1.0f;
};

/// Returns the cone of a block of the unit square that the image fills. A surface sees a direction
/// of a cone with half angle theta if its normal is less than 90 degrees + theta away from the
/// axis, that is, n.axis > -sin(theta). A wide cone does not bound the height of its light above
/// the surface, so it has no axis, and counts equally for all normals.
TileCone cone_around(Vec2 begin, Vec2 end)
{
    constexpr float min_cosine = 0.5f;
    constexpr float rounding = 1e-3f;
    const SinCos phi = sin_cos(pi * (begin.x + end.x - 1.0f));
    const SinCos theta = sin_cos(0.5f * pi * (begin.y + end.y));
    // The directions farthest from the centre are corners, or points between them beyond 90
    // degrees.
    const float cos_half_width = sin_cos(pi * (end.x - begin.x)).cos;
    float cosine = 1.0f;
    for (const float v : {begin.y, end.y}) {
        const SinCos edge = sin_cos(pi * v);
        cosine = std::min(cosine, theta.cos * edge.cos + theta.sin * edge.sin * cos_half_width);
    }
    if (cosine < min_cosine) {
        return {};
    }
    return {.axis = {theta.sin * phi.sin, theta.cos, -theta.sin * phi.cos},
            .reach = std::sqrt(1.0f - std::min(cosine * cosine, 1.0f)) + rounding};
}

/// Adds the second half of 2 `Count` numbers to the first. The sums are independent, and vectors of
/// any width add in the same order.
template <std::size_t Count>
void fold(float* numbers)
{
    for (std::size_t i = 0; i < Count; ++i) {
        numbers[i] += numbers[i + Count];
    }
}

struct Pick {
    std::size_t index = 0;
    float u = 0.0f;  ///< again uniform
};

/// Picks one of `count` numbers in proportion to them; they are `Stride` apart. `sum`, their sum,
/// is positive.
template <std::size_t Stride>
Pick pick(const float* numbers, std::size_t count, float sum, float u)
{
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

/// Returns the number of parts per side of a tile, for its dim weights.
std::uint32_t count_parts(std::uint32_t cells)
{
    constexpr std::uint32_t most = 16;
    return std::min(cells, most);
}

/// Returns the sums of the weights of a tile's cells over its parts.
std::vector<float> sums_of_parts(std::span<const float> weights, std::uint32_t columns,
                                 std::uint32_t rows)
{
    const std::uint32_t across = count_parts(columns);
    std::vector<double> sums(std::size_t{across} * count_parts(rows), 0.0);
    for (std::uint32_t y = 0; y < rows; ++y) {
        const std::size_t first = std::size_t{find_part(y, count_parts(rows), rows)} * across;
        for (std::uint32_t i = 0; i < across; ++i) {
            const std::uint32_t end = begin_of_part(i + 1, across, columns);
            for (std::uint32_t x = begin_of_part(i, across, columns); x < end; ++x) {
                sums[first + i] += static_cast<double>(weights[std::size_t{y} * columns + x]);
            }
        }
    }
    return {sums.begin(), sums.end()};
}

/// Reads rows of weights and splits off the dim part.
class WeightRows {
public:
    explicit WeightRows(const EnvironmentWeights& weights)
        : weights_(weights), row_(static_cast<std::size_t>(weights.width))
    {
        for (int y = 0; y < weights.height; ++y) {
            for (const float weight : row(y)) {
                total_ += static_cast<double>(weight);
            }
        }
    }

    [[nodiscard]] double total() const { return total_; }
    [[nodiscard]] std::span<const float> row(int y)
    {
        weights_.of_row(y, row_);
        return row_;
    }
    /// Returns the maximum dim weight of a texel in this row: half of its weight if all weight were
    /// uniform over the sphere.
    [[nodiscard]] float max_dim_weight(int y) const
    {
        return weights_.row_shares.empty()
                   ? 0.0f
                   : static_cast<float>(
                         0.5 * total_ *
                         static_cast<double>(weights_.row_shares[static_cast<std::size_t>(y)]) /
                         weights_.width);
    }

private:
    const EnvironmentWeights& weights_;
    std::vector<float> row_;
    double total_ = 0.0;
};

}  // namespace

EnvironmentTiles::EnvironmentTiles(const EnvironmentWeights& weights)
    : cells_of_weight_((tile_columns - 1) / static_cast<std::uint32_t>(weights.width) + 1),
      width_(static_cast<std::uint32_t>(weights.width) * cells_of_weight_),
      height_(static_cast<std::uint32_t>(weights.height)),
      rows_(std::min(height_, max_rows)),
      all_{},
      bright_{}
{
    for (std::uint32_t i = 0; i <= tile_columns; ++i) {
        column_begins_[i] = begin_of_part(i, tile_columns, width_);
    }
    for (std::uint32_t j = 0; j <= rows_; ++j) {
        row_begins_[j] = begin_of_part(j, rows_, height_);
    }
    cells_.reserve(std::size_t{width_} * height_, std::size_t{tile_columns} * height_);
    WeightRows rows(weights);
    std::array<std::vector<float>, tile_columns> bright;
    std::array<std::vector<float>, tile_columns> dim;
    for (std::uint32_t j = 0; j < rows_; ++j) {
        for (std::uint32_t i = 0; i < tile_columns; ++i) {
            bright[i].clear();
            dim[i].clear();
        }
        for (std::uint32_t y = row_begins_[j]; y < row_begins_[j + 1]; ++y) {
            const std::span<const float> row = rows.row(static_cast<int>(y));
            const float max_dim_weight = rows.max_dim_weight(static_cast<int>(y));
            for (std::uint32_t i = 0; i < tile_columns; ++i) {
                for (std::uint32_t x = column_begins_[i]; x < column_begins_[i + 1]; ++x) {
                    const float weight = row[x / cells_of_weight_];
                    const float below = std::min(weight, max_dim_weight);
                    bright[i].push_back(weight - below);
                    dim[i].push_back(below);
                }
            }
        }
        for (std::uint32_t i = 0; i < tile_columns; ++i) {
            const std::size_t tile = i * max_rows + j;
            add_shape(tile, {column_begins_[i], column_begins_[i + 1]},
                      {row_begins_[j], row_begins_[j + 1]});
            add_tile(tile, bright[i], dim[i], rows.total());
        }
    }
    for (Worth* shares : {&all_, &bright_}) {
        alignas(16) Worth::Pairs pairs{};
        std::copy_n(shares->of.begin(), pairs.size(), pairs.begin());
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            pairs[i] += shares->of[i + pairs.size()];
        }
        shares->sum_up(pairs);
    }
}

void EnvironmentTiles::add_shape(std::size_t tile, Range columns, Range rows)
{
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

void EnvironmentTiles::add_tile(std::size_t tile, std::span<const float> bright,
                                std::span<const float> dim, double total)
{
    const auto compute_sum = [](std::span<const float> weights) {
        double sum = 0.0;
        for (const float weight : weights) {
            sum += static_cast<double>(weight);
        }
        return sum;
    };
    const double light = compute_sum(bright);
    const double rest = compute_sum(dim);
    const double of_total =
        total > 0.0 ? 1.0 / (total * static_cast<double>(cells_of_weight_)) : 0.0;
    all_.of[tile] = static_cast<float>((light + rest) * of_total);
    bright_.of[tile] = static_cast<float>(light * of_total);
    bright_in_tile_[tile] = rest > 0.0 ? static_cast<float>(light / (light + rest)) : 1.0f;
    grid_of_tile_[tile] = grids_++;
    cells_.add(bright, count_columns(tile));
    parts_.add(sums_of_parts(dim, count_columns(tile), count_rows(tile)),
               count_parts(count_columns(tile)));
}

void EnvironmentTiles::Worth::sum_up(Pairs& pairs) noexcept
{
    static_assert(tile_columns == 16 && max_rows == 8);
    fold<32>(pairs.data());
    fold<16>(pairs.data());
    fold<8>(pairs.data());
    std::copy_n(pairs.begin(), max_rows, row_sums.begin());
    fold<4>(pairs.data());
    sum = (pairs[0] + pairs[2]) + (pairs[1] + pairs[3]);
}

double EnvironmentTiles::solid_angle(std::size_t tile) const noexcept
{
    const auto cosine = [this](std::uint32_t row) {
        return static_cast<double>(
            sin_cos(pi * static_cast<float>(row) / static_cast<float>(height_)).cos);
    };
    const std::size_t row = std::min<std::size_t>(tile % max_rows, rows_ - 1U);
    const double columns = count_columns(tile);
    return 2.0 * static_cast<double>(pi) * columns / width_ *
           (cosine(row_begins_[row]) - cosine(row_begins_[row + 1]));
}

EnvironmentTiles::Worth EnvironmentTiles::worth(const Worth& shares,
                                                const std::optional<Vec3>& normal,
                                                const TileFactors* factors) const noexcept
{
    Worth result;
    alignas(16) Worth::Pairs pairs;
    // One pass over the tiles, in vectors.
    const auto fill = [&](const auto& worth_of) {
        for (std::size_t tile = 0; tile < pairs.size(); ++tile) {
            const float first = worth_of(tile);
            const float second = worth_of(tile + pairs.size());
            result.of[tile] = first;
            result.of[tile + pairs.size()] = second;
            pairs[tile] = first + second;
        }
    };
    const auto seen_share = [&, n = normal.value_or(Vec3(0.0f))](std::size_t tile) {
        const float height =
            n.x * axis_x_[tile] + n.y * axis_y_[tile] + n.z * axis_z_[tile] + reach_[tile];
        return (height > 0.0f ? height : 0.0f) * shares.of[tile];
    };
    if (normal && factors != nullptr) {
        fill([&](std::size_t tile) { return seen_share(tile) * factors->of[tile]; });
    } else if (normal) {
        fill(seen_share);
    } else if (factors != nullptr) {
        fill([&](std::size_t tile) { return shares.of[tile] * factors->of[tile]; });
    } else {
        return shares;
    }
    result.sum_up(pairs);
    return result;
}

float EnvironmentTiles::density(std::size_t tile, const Worth& worth, float cell_pdf) const noexcept
{
    return worth.of[tile] / worth.sum * (cell_pdf * tiles_in_image_[tile]);
}

float EnvironmentTiles::cell_pdf(std::size_t tile, std::uint32_t column, std::uint32_t row,
                                 EnvironmentSampling sampling) const noexcept
{
    const std::uint32_t columns = count_columns(tile);
    const std::uint32_t rows = count_rows(tile);
    const std::size_t grid = grid_of_tile_[tile];
    const float bright = bright_pdf(tile, cells_.probability(grid, column, row));
    if (!samples_dim(tile, sampling)) {
        return bright;
    }
    const std::uint32_t i = find_part(column, count_parts(columns), columns);
    const std::uint32_t j = find_part(row, count_parts(rows), rows);
    const Range part_columns = part(i, count_parts(columns), columns);
    const Range part_rows = part(j, count_parts(rows), rows);
    const float dim = parts_.probability(grid, i, j) *
                      (static_cast<float>(columns) / static_cast<float>(part_columns.size()) *
                       (static_cast<float>(rows) / static_cast<float>(part_rows.size())));
    return bright_in_tile_[tile] * bright + (1.0f - bright_in_tile_[tile]) * dim;
}

std::optional<EnvironmentTiles::Sample> EnvironmentTiles::sample(
    Vec2 u, const Worth& worth, EnvironmentSampling sampling) const noexcept
{
    if (!(worth.sum > 0.0f)) {
        return std::nullopt;
    }
    const Pick row = pick<1>(worth.row_sums.data(), rows_, worth.sum, u.y);
    const Pick column =
        pick<max_rows>(&worth.of[row.index], tile_columns, worth.row_sums[row.index], u.x);
    const std::size_t tile = column.index * max_rows + row.index;
    const CellTables::Cell cell = sample_cell(tile, {column.u, row.u}, sampling);
    const float in_tile = samples_dim(tile, sampling)
                              ? cell_pdf(tile, cell.column, cell.row, sampling)
                              : bright_pdf(tile, cell.probability);
    const float pdf = density(tile, worth, in_tile);
    if (!(pdf > 0.0f)) {
        return std::nullopt;
    }
    return Sample{.column = static_cast<int>(column_begins_[column.index] + cell.column),
                  .row = static_cast<int>(row_begins_[row.index] + cell.row),
                  .offset = cell.offset,
                  .pdf = pdf};
}

CellTables::Cell EnvironmentTiles::sample_cell(std::size_t tile, Vec2 u,
                                               EnvironmentSampling sampling) const noexcept
{
    const std::size_t grid = grid_of_tile_[tile];
    const float bright = bright_in_tile_[tile];
    if (!samples_dim(tile, sampling)) {
        return cells_.sample(grid, u);
    }
    if (u.y < bright) {
        return cells_.sample(grid, {u.x, std::min(u.y / bright, below_one)});
    }
    const float left = std::min((u.y - bright) / (1.0f - bright), below_one);
    const CellTables::Cell of_parts = parts_.sample(grid, {u.x, left});
    // A part is uniform: the position in it determines the cell.
    const auto place = [](Range cells, float offset, std::uint32_t& cell, float& in_cell) {
        const float at = offset * static_cast<float>(cells.size());
        const std::uint32_t whole = std::min(static_cast<std::uint32_t>(at), cells.size() - 1);
        cell = cells.begin + whole;
        in_cell = std::min(at - static_cast<float>(whole), below_one);
    };
    const std::uint32_t columns = count_columns(tile);
    const std::uint32_t rows = count_rows(tile);
    CellTables::Cell cell;
    place(part(of_parts.column, count_parts(columns), columns), of_parts.offset.x, cell.column,
          cell.offset.x);
    place(part(of_parts.row, count_parts(rows), rows), of_parts.offset.y, cell.row, cell.offset.y);
    return cell;
}

std::optional<EnvironmentTiles::Sample> EnvironmentTiles::sample(
    Vec2 u, const std::optional<Vec3>& normal, const TileFactors* factors,
    EnvironmentSampling sampling) const noexcept
{
    return normal || factors != nullptr
               ? sample(u, worth(shares(sampling), normal, factors), sampling)
               : sample(u, shares(sampling), sampling);
}

std::size_t EnvironmentTiles::find_tile(int column, int row) const noexcept
{
    return find_part(static_cast<std::uint32_t>(column), tile_columns, width_) * max_rows +
           find_part(static_cast<std::uint32_t>(row), rows_, height_);
}

float EnvironmentTiles::pdf_in_tile(std::size_t tile, int column, int row,
                                    EnvironmentSampling sampling) const noexcept
{
    return cell_pdf(tile, static_cast<std::uint32_t>(column) - column_begins_[tile / max_rows],
                    static_cast<std::uint32_t>(row) - row_begins_[tile % max_rows], sampling);
}

float EnvironmentTiles::pdf(int column, int row, const std::optional<Vec3>& normal,
                            const TileFactors* factors, EnvironmentSampling sampling) const noexcept
{
    const std::size_t tile = find_tile(column, row);
    const Worth& known = shares(sampling);
    if (!(known.of[tile] > 0.0f)) {
        return 0.0f;
    }
    const float in_tile = pdf_in_tile(tile, column, row, sampling);
    if ((!normal && factors == nullptr) || !(in_tile > 0.0f)) {
        return density(tile, known, in_tile);
    }
    const Worth seen = worth(known, normal, factors);
    return seen.of[tile] > 0.0f ? density(tile, seen, in_tile) : 0.0f;
}

EnvironmentTiles::Worth EnvironmentTiles::worth(const TileFactors& factors,
                                                EnvironmentSampling sampling) const noexcept
{
    return worth(shares(sampling), std::nullopt, &factors);
}

float EnvironmentTiles::pdf(int column, int row, const Worth& worth,
                            EnvironmentSampling sampling) const noexcept
{
    const std::size_t tile = find_tile(column, row);
    return worth.of[tile] > 0.0f ? density(tile, worth, pdf_in_tile(tile, column, row, sampling))
                                 : 0.0f;
}

}  // namespace bdpt
