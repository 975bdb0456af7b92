#include "light/environment/cell_tables.h"

#include "math/rgb.h"

#include <bdpt/memory/huge_pages.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace bdpt {
namespace {

/// Returns the number of cells along a side of that many texels: each covers a whole number of
/// texels, if that divides them.
int cells_along(int texels, int most)
{
    const int of_cell = (texels - 1) / most + 1;
    return (texels - 1) / of_cell + 1;
}

/// The range of texels that a cell covers, with fractions.
struct Covered {
    double begin;
    double end;

    Covered(int cell, int cells, int texels)
        : begin(static_cast<double>(cell) * texels / cells),
          end(static_cast<double>(cell + 1) * texels / cells)
    {}
    [[nodiscard]] int first() const { return static_cast<int>(begin); }
    [[nodiscard]] float share(int texel) const
    {
        return static_cast<float>(std::min<double>(texel + 1, end) -
                                  std::max<double>(texel, begin));
    }
};

}  // namespace

CellWeights::CellWeights(const EnvironmentTexels& texels, std::vector<float> row_shares)
    : texels_(texels),
      row_shares_(std::move(row_shares)),
      columns_(cells_along(texels.width(), 2048)),
      rows_(cells_along(texels.height(), 1024)),
      scale_(texels.greatest() >= std::numeric_limits<float>::min() ? 1.0f / texels.greatest()
                                                                    : 0.0f),
      sums_(static_cast<std::size_t>(texels.width()) + 2),
      of_row_(static_cast<std::size_t>(texels.width()))
{}

void CellWeights::of_row(int row, std::span<float> weights)
{
    std::fill(of_row_.begin(), of_row_.end(), 0.0f);
    const Covered covered(row, rows_, texels_.height());
    for (int y = covered.first(); y < texels_.height() && y < covered.end; ++y) {
        add_texels(y, covered.share(y) * row_shares_[static_cast<std::size_t>(y)]);
    }
    if (columns_ == texels_.width()) {
        std::copy(of_row_.begin(), of_row_.end(), weights.begin());
        return;
    }
    for (int cell = 0; cell < columns_; ++cell) {
        const Covered across(cell, columns_, texels_.width());
        float sum = 0.0f;
        for (int x = across.first(); x < texels_.width() && x < across.end; ++x) {
            sum += across.share(x) * of_row_[static_cast<std::size_t>(x)];
        }
        weights[static_cast<std::size_t>(cell)] = sum;
    }
}

void CellWeights::add_texels(int y, float share)
{
    const std::vector<float>& own = luminances(y);
    const std::vector<float>& above = luminances(std::max(y - 1, 0));
    const std::vector<float>& below = luminances(std::min(y + 1, texels_.height() - 1));
    const std::size_t width = of_row_.size();
    for (std::size_t x = 0; x < width; ++x) {
        sums_[x + 1] = above[x] + own[x] + below[x];
    }
    sums_.front() = sums_[width];
    sums_.back() = sums_[1];
    for (std::size_t x = 0; x < width; ++x) {
        of_row_[x] += (sums_[x] + sums_[x + 1] + sums_[x + 2] + 3.0f * own[x]) * share;
    }
}

/// Returns the luminances of a row of texels relative to the maximum, so that no sum overflows.
const std::vector<float>& CellWeights::luminances(int y)
{
    Row& row = cached_[static_cast<std::size_t>(y) % cached_.size()];
    if (row.y != y) {
        row.y = y;
        row.luminances.resize(of_row_.size());
        for (int x = 0; x < texels_.width(); ++x) {
            row.luminances[static_cast<std::size_t>(x)] = luminance(texels_(x, y) * scale_);
        }
    }
    return row.luminances;
}

namespace {

/// Cumulative sums of a row of numbers, which add up to `total`, preceded by a guide table: for
/// each of 16 equal parts of the total, the index of the number that contains its begin.
template <typename Word, std::uint32_t total>
struct Steps {
    static constexpr std::uint32_t guides = 16;
    /// Size of a part, rounded up, so that no sum lies beyond the last part.
    static constexpr std::uint32_t guided = total / guides + 1;

    struct Place {
        std::uint32_t index = 0;
        float offset = 0.0f;  ///< fraction of the number, in [0, 1)
        float width = 0.0f;   ///< the number, of `total`
    };

    /// Appends the sums of `weights`, whose sum is positive. Each positive weight gets one unit,
    /// and its share of the rest.
    static void append(std::span<const float> weights, std::vector<Word>& to)
    {
        double sum = 0.0;
        std::uint32_t positive = 0;
        for (const float weight : weights) {
            sum += static_cast<double>(weight);
            positive += weight > 0.0f ? 1U : 0U;
        }
        const std::uint32_t rest = total - positive;
        constexpr double rounding = 0x1p-20;  // error of sums of equal numbers
        const double scale = static_cast<double>(rest) / sum;
        const std::size_t begin = to.size();
        to.resize(begin + guides + weights.size());
        Word* const steps = to.data() + begin + guides;
        double before = 0.0;
        std::uint32_t count = 0;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            steps[i] = static_cast<Word>(
                count + std::min(static_cast<std::uint32_t>(before * scale + rounding), rest));
            before += static_cast<double>(weights[i]);
            count += weights[i] > 0.0f ? 1U : 0U;
        }
        // Weights after the last positive one start at the end, regardless of rounding.
        for (std::size_t i = weights.size(); i > 0 && !(weights[i - 1] > 0.0f); --i) {
            steps[i - 1] = static_cast<Word>(total);
        }
        std::size_t at = 0;
        for (std::uint32_t guide = 0; guide < guides; ++guide) {
            while (at + 1 < weights.size() && steps[at + 1] <= guide * guided) {
                ++at;
            }
            to[begin + guide] = static_cast<Word>(at);
        }
    }

    [[nodiscard]] static std::uint32_t width(const Word* row, std::uint32_t count,
                                             std::uint32_t i) noexcept
    {
        const Word* const steps = row + guides;
        return (i + 1 < count ? steps[i + 1] : total) - steps[i];
    }

    /// Returns the last number that starts at u or before; never one without width.
    [[nodiscard]] static Place find(const Word* row, std::uint32_t count, float u) noexcept
    {
        constexpr float below_one = 0x1.fffffep-1f;
        const Word* const steps = row + guides;
        const float at = u * static_cast<float>(total);
        const auto whole = static_cast<std::uint32_t>(at);
        const std::uint32_t guide = whole / guided;
        std::uint32_t first = row[guide];
        std::uint32_t beyond = guide + 1 < guides ? row[guide + 1] + 1U : count;
        while (beyond - first > 1) {
            const std::uint32_t middle = first + (beyond - first) / 2;
            const bool is_before = steps[middle] <= whole;
            first = is_before ? middle : first;
            beyond = is_before ? beyond : middle;
        }
        const auto size = static_cast<float>(width(row, count, first));
        return {.index = first,
                .offset = std::min((at - static_cast<float>(steps[first])) / size, below_one),
                .width = size};
    }
};

/// A multiple of 128, so that uniform rows of up to 128 cells in powers of two stay uniform.
constexpr std::uint32_t parts_of_row = 511 * 128;
using CellSteps = Steps<std::uint16_t, parts_of_row>;
using RowSteps = Steps<std::uint32_t, 0x1000000>;

/// Returns the probability of a cell of this width in a row of this width.
float probability_of(float row, float cell)
{
    return row * 0x1p-24f * (cell / static_cast<float>(parts_of_row));
}

}  // namespace

void CellTables::reserve(std::size_t cells, std::size_t rows)
{
    reserve_in_huge_pages(cells_, cells_.size() + cells + rows * CellSteps::guides);
}

void CellTables::add(std::span<const float> weights, std::size_t columns)
{
    const std::size_t rows = weights.size() / columns;
    grids_.push_back({.cells = cells_.size(),
                      .rows = rows_.size(),
                      .columns = static_cast<std::uint32_t>(columns),
                      .row_count = static_cast<std::uint32_t>(rows)});
    std::vector<float> sums;
    bool any = false;
    for (std::size_t y = 0; y < rows; ++y) {
        const auto row = weights.subspan(y * columns, columns);
        double sum = 0.0;
        for (const float weight : row) {
            sum += static_cast<double>(weight);
        }
        sums.push_back(static_cast<float>(sum));
        any = any || sum > 0.0;
        if (sum > 0.0) {
            CellSteps::append(row, cells_);
        } else {
            cells_.resize(cells_.size() + CellSteps::guides + columns);
        }
    }
    if (any) {
        RowSteps::append(sums, rows_);
    } else {
        rows_.resize(rows_.size() + RowSteps::guides + rows, 0x1000000);
    }
}

const std::uint16_t* CellTables::steps_of_row(const Grid& grid, std::uint32_t row) const noexcept
{
    return cells_.data() + grid.cells +
           std::size_t{row} * (CellSteps::guides + std::size_t{grid.columns});
}

CellTables::Cell CellTables::sample(std::size_t grid, Vec2 u) const noexcept
{
    const Grid& of = grids_[grid];
    const auto row = RowSteps::find(rows_.data() + of.rows, of.row_count, u.y);
    const auto column = CellSteps::find(steps_of_row(of, row.index), of.columns, u.x);
    return {.column = column.index,
            .row = row.index,
            .offset = {column.offset, row.offset},
            .probability = probability_of(row.width, column.width)};
}

float CellTables::probability(std::size_t grid, std::uint32_t column,
                              std::uint32_t row) const noexcept
{
    const Grid& of = grids_[grid];
    const auto of_row =
        static_cast<float>(RowSteps::width(rows_.data() + of.rows, of.row_count, row));
    if (!(of_row > 0.0f)) {
        return 0.0f;
    }
    const auto of_cell =
        static_cast<float>(CellSteps::width(steps_of_row(of, row), of.columns, column));
    return probability_of(of_row, of_cell);
}

std::size_t CellTables::bytes() const noexcept
{
    return cells_.size() * sizeof(cells_[0]) + rows_.size() * sizeof(rows_[0]) +
           grids_.size() * sizeof(grids_[0]);
}

}  // namespace bdpt
