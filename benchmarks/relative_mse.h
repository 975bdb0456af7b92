#pragma once

#include <bdpt/image.h>

#include <cstddef>

namespace bdpt {

/// Mean of (x - r)^2 / (r^2 + 0.01) over pixels and channels.
[[nodiscard]] inline double relative_mse(const Image& image, const Image& reference)
{
    double sum = 0.0;
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            const double r = static_cast<double>(reference.pixels[i][c]);
            const double difference = static_cast<double>(image.pixels[i][c]) - r;
            sum += difference * difference / (r * r + 0.01);
        }
    }
    return sum / (3.0 * static_cast<double>(image.pixels.size()));
}

}  // namespace bdpt
