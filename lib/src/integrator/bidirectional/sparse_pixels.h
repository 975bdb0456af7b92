#pragma once

#include <algorithm>

namespace bdpt {

/// Selects few of an image's samples at random: those of pixels on a grid, each with the same
/// chance. Samples of other pixels are skipped without a random number.
class SparsePixels {
public:
    /// `share` is the selected fraction of the samples of an image of this size; all pixels are on
    /// the grid unless it is below 1/256.
    SparsePixels(float share, int width, int height) : chance_(share)
    {
        constexpr float max_chance = 1.0f / 64.0f;
        const float all = share * static_cast<float>(width) * static_cast<float>(height);
        const int longest = std::max(width, height);
        for (int stride = 2; all > 0.0f && stride < longest; stride *= 2) {
            const float chance = all / static_cast<float>(count(width, stride)) /
                                 static_cast<float>(count(height, stride));
            if (chance > max_chance) {
                break;
            }
            stride_ = stride;
            chance_ = chance;
        }
    }

    /// Returns the distance of the columns and rows of these pixels.
    [[nodiscard]] int stride() const { return stride_; }
    [[nodiscard]] bool contains(int x, int y) const { return x % stride_ == 0 && y % stride_ == 0; }
    /// Returns the chance that a sample of these pixels is selected.
    [[nodiscard]] float chance() const { return chance_; }

private:
    [[nodiscard]] static int count(int side, int stride) { return (side + stride - 1) / stride; }

    int stride_ = 1;
    float chance_;
};

}  // namespace bdpt
