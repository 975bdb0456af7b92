#pragma once

#include <bdpt/image.h>

#include "statistics.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt::test {

/// One row of pixels.
[[nodiscard]] inline Image row_of(const std::vector<Rgb>& pixels)
{
    return {static_cast<int>(pixels.size()), 1, pixels};
}

[[nodiscard]] inline Image flat(int width, int height, Rgb color)
{
    return {width, height,
            std::vector<Rgb>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height),
                             color)};
}

[[nodiscard]] inline Image scaled(Image image, float factor)
{
    for (Rgb& pixel : image.pixels) {
        pixel *= factor;
    }
    return image;
}

/// Uniform numbers in [0, most).
[[nodiscard]] inline Image random_image(int width, int height, std::uint64_t seed,
                                        float most = 1.0f)
{
    Random random(seed);
    Image image = flat(width, height, Rgb(0.0f));
    for (Rgb& pixel : image.pixels) {
        const float red = most * random.next();
        const float green = most * random.next();
        pixel = Rgb(red, green, most * random.next());
    }
    return image;
}

}  // namespace bdpt::test
