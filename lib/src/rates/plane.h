#pragma once

#include <vector>

namespace bdpt {

/// Values of pixels or cells, row by row from the top left.
using Plane = std::vector<double>;

struct PlaneSize {
    int width;
    int height;
};

/// Returns the mean over a square of (2 radius + 1) x (2 radius + 1) values around each; squares
/// end at the edges.
[[nodiscard]] Plane local_mean(const Plane& plane, PlaneSize size, int radius);
/// Returns the greatest value of each of those squares.
[[nodiscard]] Plane local_greatest(const Plane& plane, PlaneSize size, int radius);
[[nodiscard]] double mean_of(const Plane& plane);

}  // namespace bdpt
