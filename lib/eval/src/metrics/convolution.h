#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace bdpt::eval {

/// One value per pixel, row-major.
struct Plane {
    int width = 0;
    int height = 0;
    std::vector<float> values;

    Plane(int columns, int rows)
        : width(columns),
          height(rows),
          values(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows))
    {}
    [[nodiscard]] std::span<float> row(int y) { return {&values[begin(y)], columns()}; }
    [[nodiscard]] std::span<const float> row(int y) const { return {&values[begin(y)], columns()}; }

private:
    [[nodiscard]] std::size_t columns() const { return static_cast<std::size_t>(width); }
    [[nodiscard]] std::size_t begin(int y) const { return static_cast<std::size_t>(y) * columns(); }
};

/// Weights of the pixels at distances -radius to radius; an odd number of them.
using Kernel = std::vector<float>;

/// Correlates rows with `horizontal` and columns with `vertical`. The border pixels are replicated
/// beyond the border.
[[nodiscard]] Plane convolve(const Plane& plane, const Kernel& horizontal, const Kernel& vertical);

}  // namespace bdpt::eval
