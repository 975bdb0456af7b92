#include "math/distribution_2d.h"

#include <algorithm>
#include <cstddef>

namespace bdpt {
namespace {

/// Appends cumulative sums from 0 to exactly 1 of `weights`; uniform steps if all are zero.
void append_cdf(std::span<const float> weights, std::vector<float>& cdf)
{
    double total = 0.0;
    for (const float w : weights) {
        total += static_cast<double>(w);
    }
    const double uniform = 1.0 / static_cast<double>(weights.size());
    double sum = 0.0;
    cdf.push_back(0.0f);
    for (const float w : weights) {
        sum += total > 0.0 ? static_cast<double>(w) / total : uniform;
        cdf.push_back(static_cast<float>(sum));
    }
    // Cells after the last one with weight keep a width of zero.
    const float last = cdf.back();
    for (auto it = cdf.rbegin(); it != cdf.rend() && *it == last; ++it) {
        *it = 1.0f;
    }
}

struct Inverted {
    int cell;
    float offset;  // within the cell, [0, 1)
};

Inverted invert(std::span<const float> cdf, float u)
{
    const auto after = std::upper_bound(cdf.begin(), cdf.end(), u);
    const auto last_cell = static_cast<std::ptrdiff_t>(cdf.size()) - 2;
    const auto cell = std::clamp<std::ptrdiff_t>(after - cdf.begin() - 1, 0, last_cell);
    const float begin = cdf[static_cast<std::size_t>(cell)];
    const float width = cdf[static_cast<std::size_t>(cell) + 1] - begin;
    constexpr float below_one = 0x1.fffffep-1f;
    const float offset = width > 0.0f ? std::min((u - begin) / width, below_one) : 0.5f;
    return {static_cast<int>(cell), offset};
}

}  // namespace

Distribution2D::Distribution2D(std::span<const float> weights, int width, int height)
    : width_(width), height_(height)
{
    const auto columns = static_cast<std::size_t>(width);
    std::vector<float> row_sums;
    cell_cdf_.reserve((columns + 1) * static_cast<std::size_t>(height));
    for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
        const auto row = weights.subspan(y * columns, columns);
        double sum = 0.0;
        for (const float w : row) {
            sum += static_cast<double>(w);
        }
        row_sums.push_back(static_cast<float>(sum));
        append_cdf(row, cell_cdf_);
    }
    append_cdf(row_sums, row_cdf_);
}

float Distribution2D::cell_pdf(int x, int y) const
{
    const auto row = static_cast<std::size_t>(y);
    const auto cell = row * (static_cast<std::size_t>(width_) + 1) + static_cast<std::size_t>(x);
    return (row_cdf_[row + 1] - row_cdf_[row]) * static_cast<float>(height_) *
           (cell_cdf_[cell + 1] - cell_cdf_[cell]) * static_cast<float>(width_);
}

Distribution2D::Cell Distribution2D::sample_cell(Vec2 u) const
{
    const auto columns = static_cast<std::size_t>(width_) + 1;
    const Inverted row = invert(row_cdf_, u.y);
    const Inverted column = invert(
        std::span(cell_cdf_).subspan(static_cast<std::size_t>(row.cell) * columns, columns), u.x);
    return {.column = column.cell,
            .row = row.cell,
            .offset = {column.offset, row.offset},
            .pdf = cell_pdf(column.cell, row.cell)};
}

Distribution2D::Sample Distribution2D::sample(Vec2 u) const
{
    const Cell cell = sample_cell(u);
    return {
        .point = {(static_cast<float>(cell.column) + cell.offset.x) / static_cast<float>(width_),
                  (static_cast<float>(cell.row) + cell.offset.y) / static_cast<float>(height_)},
        .pdf = cell.pdf};
}

float Distribution2D::pdf(Vec2 point) const
{
    const int x = std::clamp(static_cast<int>(point.x * static_cast<float>(width_)), 0, width_ - 1);
    const int y =
        std::clamp(static_cast<int>(point.y * static_cast<float>(height_)), 0, height_ - 1);
    return cell_pdf(x, y);
}

}  // namespace bdpt
