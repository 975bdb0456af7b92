#pragma once

#include <cstddef>
#include <vector>

namespace bdpt::eval {

/// Error of each pixel; row-major, row 0 is the top row.
struct ErrorMap {
    int width = 0;
    int height = 0;
    std::vector<double> values;  ///< width * height

    /// Returns the error of a pixel, `x` in [0, width), `y` in [0, height).
    [[nodiscard]] double at(int x, int y) const
    {
        return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)];
    }
};

}  // namespace bdpt::eval
