#include "math/distributions.h"

#include <cmath>
#include <limits>

namespace bdpt {
namespace {

[[nodiscard]] double usable(float weight)
{
    return std::isfinite(weight) && weight > 0.0f ? static_cast<double>(weight) : 0.0;
}

}  // namespace

AliasTable::AliasTable(std::span<const float> weights)
{
    double sum = 0.0;
    for (const float weight : weights) {
        sum += usable(weight);
    }
    if (sum <= 0.0) {
        return;
    }
    total_ = sum;
    const std::size_t count = weights.size();
    buckets_.resize(count);

    // Weights are scaled to a mean of one, then every bucket is filled to exactly one: an index
    // with too little weight takes the rest from one with too much.
    std::vector<double> level(count);
    std::vector<std::uint32_t> too_little;
    std::vector<std::uint32_t> too_much;
    std::uint32_t heaviest = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto share = static_cast<float>(usable(weights[i]) / sum);
        const bool drawable = share >= std::numeric_limits<float>::min();
        level[i] = drawable ? usable(weights[i]) / sum * static_cast<double>(count) : 0.0;
        buckets_[i] = {1.0f, i, drawable ? share : 0.0f};
        heaviest = share > buckets_[heaviest].probability ? i : heaviest;
        (level[i] < 1.0 ? too_little : too_much).push_back(i);
    }
    while (!too_little.empty() && !too_much.empty()) {
        const std::uint32_t poor = too_little.back();
        const std::uint32_t rich = too_much.back();
        too_little.pop_back();
        buckets_[poor].threshold = static_cast<float>(level[poor]);
        buckets_[poor].alias = rich;
        level[rich] -= 1.0 - level[poor];
        if (level[rich] < 1.0) {
            too_much.pop_back();
            too_little.push_back(rich);
        }
    }
    // Rounding may leave a few whose level is almost one; they stay full. A weight of zero among
    // them must not.
    for (const std::uint32_t i : too_little) {
        if (buckets_[i].probability == 0.0f) {
            buckets_[i].threshold = 0.0f;
            buckets_[i].alias = heaviest;
        }
    }
}

AliasTable::Choice AliasTable::sample(double u) const noexcept
{
    if (buckets_.empty()) {
        return {0, 0.0f, static_cast<float>(u)};
    }
    constexpr float below_one = 1.0f - 0x1p-24f;
    const double scaled = u * static_cast<double>(buckets_.size());
    const std::size_t slot = std::min(static_cast<std::size_t>(scaled), buckets_.size() - 1);
    const Bucket& bucket = buckets_[slot];
    const double within = scaled - static_cast<double>(slot);
    const double threshold = static_cast<double>(bucket.threshold);
    if (within < threshold) {
        return {static_cast<std::uint32_t>(slot), bucket.probability,
                std::min(static_cast<float>(within / threshold), below_one)};
    }
    const double rest = (within - threshold) / (1.0 - threshold);
    return {bucket.alias, buckets_[bucket.alias].probability,
            std::min(static_cast<float>(rest), below_one)};
}

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
