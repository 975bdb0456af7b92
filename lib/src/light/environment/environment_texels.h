#pragma once

#include <bdpt/image.h>
#include <bdpt/types.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt {

/// Radiance of an environment's texels, as half floats times a power of two: 6 bytes per texel,
/// without rounding for files of half floats and Radiance files. If the range of an image is wider,
/// its texels stay floats (docs/decisions/0070-compact-environments.md).
class EnvironmentTexels {
public:
    /// Stores `image`, which is finite and not negative.
    explicit EnvironmentTexels(const Image& image);

    [[nodiscard]] int width() const noexcept { return width_; }
    [[nodiscard]] int height() const noexcept { return height_; }
    [[nodiscard]] Rgb operator()(int x, int y) const noexcept
    {
        const std::size_t first =
            3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                 static_cast<std::size_t>(x));
        if (!halves_.empty()) [[likely]] {
            const std::uint16_t* const texel = halves_.data() + first;
            return Rgb(decoded(texel[0]), decoded(texel[1]), decoded(texel[2])) * scale_;
        }
        const float* const texel = floats_.data() + first;
        return {texel[0], texel[1], texel[2]};
    }
    /// Returns the maximum over all channels of all texels.
    [[nodiscard]] float greatest() const noexcept { return greatest_; }
    /// Tests whether texels are half floats.
    [[nodiscard]] bool are_halves() const noexcept { return !halves_.empty(); }
    /// Returns the memory of the texels [bytes].
    [[nodiscard]] std::size_t bytes() const noexcept
    {
        return halves_.size() * sizeof(halves_[0]) + floats_.size() * sizeof(floats_[0]);
    }

private:
    /// Decodes a positive half float, by integer arithmetic if it is subnormal: rendering threads
    /// flush subnormal floats to zero.
    [[nodiscard]] static float decoded(std::uint16_t half) noexcept
    {
        constexpr std::uint32_t min_normal = 0x400;
        constexpr std::uint32_t exponent_offset = 112U << 23U;
        return half >= min_normal
                   ? std::bit_cast<float>((std::uint32_t{half} << 13U) + exponent_offset)
                   : static_cast<float>(half) * 0x1p-24f;
    }
    [[nodiscard]] bool encode(const Image& image);

    int width_;
    int height_;
    float greatest_ = 0.0f;
    float scale_ = 1.0f;
    std::vector<std::uint16_t> halves_;
    std::vector<float> floats_;  // used instead of halves
};

}  // namespace bdpt
