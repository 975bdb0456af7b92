#pragma once

#include "light/environment/environment_texels.h"

#include <array>
#include <cstddef>
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

}  // namespace bdpt
