#include "light/environment/cell_weights.h"

#include "math/rgb.h"

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

}  // namespace bdpt
