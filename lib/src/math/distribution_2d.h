#pragma once

#include <bdpt/types.h>

#include <span>
#include <vector>

namespace bdpt {

/// A density on the unit square that is constant in each cell of a grid. Sampling inverts the
/// cumulative sums, so it preserves the stratification of its random numbers.
class Distribution2D {
public:
    struct Sample {
        Vec2 point{0.0f};
        float pdf = 0.0f;
    };

    /// A cell, and a point in it.
    struct Cell {
        int column = 0;
        int row = 0;
        Vec2 offset{0.0f};  ///< position relative to the cell's corner, in [0, 1)^2 of its size
        float pdf = 0.0f;
    };

    /// `weights` are width * height values >= 0, row-major; all zero gives the uniform density.
    Distribution2D(std::span<const float> weights, int width, int height);

    [[nodiscard]] Sample sample(Vec2 u) const;
    [[nodiscard]] float pdf(Vec2 point) const;
    /// Samples a cell, and evaluates the density by cell, independent of rounding.
    [[nodiscard]] Cell sample_cell(Vec2 u) const;
    [[nodiscard]] float cell_pdf(int x, int y) const;

private:
    int width_;
    int height_;
    std::vector<float> row_cdf_;   // height + 1
    std::vector<float> cell_cdf_;  // for each row width + 1
};

}  // namespace bdpt
