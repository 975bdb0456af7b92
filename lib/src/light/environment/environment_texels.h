#pragma once

#include <bdpt/image.h>
#include <bdpt/types.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace bdpt {

/// Returns the nearest half float, ties to even, of a float in [0, 65504].
[[nodiscard]] inline std::uint16_t to_half(float value) noexcept
{
    constexpr float min_normal = 0x1p-14f;
    // Subnormal halves are multiples of 2^-24, and this sum rounds to them.
    constexpr float magic = 0.5f;
    const std::uint32_t subnormal =
        std::bit_cast<std::uint32_t>(value + magic) - std::bit_cast<std::uint32_t>(magic);
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t even = (bits >> 13U) & 1U;
    const std::uint32_t normal = (bits - (112U << 23U) + 0xfffU + even) >> 13U;
    return static_cast<std::uint16_t>(value < min_normal ? subnormal : normal);
}

/// Decodes a positive half float, by integer arithmetic if it is subnormal: rendering threads flush
/// subnormal floats to zero.
[[nodiscard]] inline float from_half(std::uint16_t half) noexcept
{
    constexpr std::uint32_t min_normal = 0x400;
    constexpr std::uint32_t exponent_offset = 112U << 23U;
    return half >= min_normal ? std::bit_cast<float>((std::uint32_t{half} << 13U) + exponent_offset)
                              : static_cast<float>(half) * 0x1p-24f;
}

/// Returns the power of two by which halves are multiplied: it scales the greatest value to their
/// range, so that no other is subnormal unnecessarily.
[[nodiscard]] float scale_of_halves(float greatest) noexcept;

/// Radiance of an environment's texels, as half floats times a power of two: 6 bytes per texel,
/// without rounding for files of half floats and Radiance files. If the range of an image is wider,
/// its texels stay floats (docs/decisions/0070-compact-environments.md).
class EnvironmentTexels {
public:
    /// What texels are besides their halves.
    struct Frame {
        int width = 0;
        int height = 0;
        float greatest = 0.0f;  ///< of all channels
        float scale = 1.0f;     ///< factor of all halves
    };

    /// Stores `image`, which is finite and not negative.
    explicit EnvironmentTexels(const Image& image);
    /// Stores the texels of `other` times `factor`, as those of an image of floats: finite and not
    /// negative.
    EnvironmentTexels(const EnvironmentTexels& other, float factor);
    /// Takes over `halves`.
    EnvironmentTexels(const Frame& frame, std::vector<std::uint16_t> halves);

    [[nodiscard]] int width() const noexcept { return width_; }
    [[nodiscard]] int height() const noexcept { return height_; }
    [[nodiscard]] Rgb operator()(int x, int y) const noexcept
    {
        const std::size_t first =
            3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                 static_cast<std::size_t>(x));
        if (!halves_.empty()) [[likely]] {
            const std::uint16_t* const texel = halves_.data() + first;
            return Rgb(from_half(texel[0]), from_half(texel[1]), from_half(texel[2])) * scale_;
        }
        const float* const texel = floats_.data() + first;
        return {texel[0], texel[1], texel[2]};
    }
    /// Starts to load a texel into the cache.
    void prefetch(int x, int y) const noexcept
    {
        const std::size_t first =
            3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                 static_cast<std::size_t>(x));
        __builtin_prefetch(are_halves() ? static_cast<const void*>(&halves_[first])
                                        : static_cast<const void*>(&floats_[first]));
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
    /// Returns the values of a row, valid until the next call.
    using Rows = std::function<std::span<const float>(int y)>;
    void store(const Rows& rows);
    [[nodiscard]] bool encode(const Rows& rows);

    int width_;
    int height_;
    float greatest_ = 0.0f;
    float scale_ = 1.0f;
    std::vector<std::uint16_t> halves_;
    std::vector<float> floats_;  // used instead of halves
};

}  // namespace bdpt
