#pragma once

/// @file
/// Holds the error of each pixel.
///
/// @code{.cpp}
/// void print_greatest(const bdpt::Image& image, const bdpt::Image& reference)
/// {
///     const bdpt::eval::ErrorMap map = bdpt::eval::flip(image, reference);
///     const auto greatest = std::max_element(map.values.begin(), map.values.end());
///     const auto index = static_cast<int>(greatest - map.values.begin());
///     std::cout << *greatest << " at " << index % map.width << ',' << index / map.width << '\n';
/// }
/// @endcode

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
