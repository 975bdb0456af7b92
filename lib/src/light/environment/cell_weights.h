#pragma once

#include "light/environment/environment_texels.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace bdpt {

/// How much each cell of an environment is sampled: by the luminance of its texels and that of
/// their neighbours, for bilinear lookups carry light over the edge, times solid angle (up to a
/// constant). Cells are texels, or in large images several of them: what is finer than a fifth of a
/// degree changes no picture's noise, but a table of it makes each sample wait for memory.
class CellWeights {
public:
    /// `row_shares`: of each row of texels, of the sphere.
    CellWeights(const EnvironmentTexels& texels, std::vector<float> row_shares);

    [[nodiscard]] int columns() const { return columns_; }
    [[nodiscard]] int rows() const { return rows_; }
    /// Writes the weights of a row of cells, at most 12. Asked for one row after the other, it
    /// looks at each texel once.
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
    std::vector<float> sums_;    // of three texels, one below the other
    std::vector<float> of_row_;  // weights of texels
};

}  // namespace bdpt
