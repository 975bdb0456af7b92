#include "light/environment/environment_texels.h"

#include <bdpt/memory/huge_pages.h>

#include <algorithm>
#include <cmath>

namespace bdpt {
namespace {

constexpr float max_half = 65504.0f;

/// Returns the nearest half float, ties to even, of a float in [0, 65504].
std::uint16_t to_half(float value)
{
    constexpr float min_normal = 0x1p-14f;
    if (value < min_normal) {
        // Subnormal halves are multiples of 2^-24, and this sum rounds to them.
        constexpr float magic = 0.5f;
        return static_cast<std::uint16_t>(std::bit_cast<std::uint32_t>(value + magic) -
                                          std::bit_cast<std::uint32_t>(magic));
    }
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t even = (bits >> 13U) & 1U;
    return static_cast<std::uint16_t>((bits - (112U << 23U) + 0xfffU + even) >> 13U);
}

/// Returns approximately the geometric mean of all channels that are not black: the mean of their
/// exponents. A sun does not change it.
float usual_brightness(const Image& image)
{
    std::int64_t sum = 0;
    std::int64_t count = 0;
    for (const Rgb& pixel : image.pixels) {
        for (int c = 0; c < 3; ++c) {
            const auto exponent =
                static_cast<std::int64_t>(std::bit_cast<std::uint32_t>(pixel[c]) >> 23U);
            sum += exponent;
            count += exponent > 0 ? 1 : 0;
        }
    }
    return count > 0 ? std::bit_cast<float>(static_cast<std::uint32_t>(sum / count) << 23U) : 0.0f;
}

}  // namespace

EnvironmentTexels::EnvironmentTexels(const Image& image)
    : width_(image.width), height_(image.height)
{
    for (const Rgb& pixel : image.pixels) {
        greatest_ = std::max({greatest_, pixel.r, pixel.g, pixel.b});
    }
    if (!encode(image)) {
        halves_ = {};
        scale_ = 1.0f;
        const float* const begin = &image.pixels[0].r;
        floats_.assign(begin, begin + 3 * image.pixels.size());
    }
}

/// Encodes the image as half floats; returns false if the error of a texel would exceed 1/2048 of
/// its value and the visible threshold beside texels of usual brightness.
bool EnvironmentTexels::encode(const Image& image)
{
    static_assert(sizeof(Rgb) == 3 * sizeof(float));
    // Scales the maximum to the range of halves, so that no texel is subnormal unnecessarily.
    while (greatest_ / scale_ > max_half) {
        scale_ *= 2.0f;
    }
    while (scale_ > 0x1p-100f && greatest_ / (0.5f * scale_) <= max_half) {
        scale_ *= 0.5f;
    }
    constexpr float relative = 0x1p-11f;
    constexpr float of_usual = 0x1p-16f;
    const float unseen = of_usual * usual_brightness(image);
    const float inverse = 1.0f / scale_;
    resize_in_huge_pages(halves_, 3 * image.pixels.size());
    const float* const values = &image.pixels[0].r;
    for (std::size_t i = 0; i < halves_.size(); ++i) {
        halves_[i] = to_half(values[i] * inverse);
        const float error = std::abs(decoded(halves_[i]) * scale_ - values[i]);
        if (error > std::max(relative * values[i], unseen)) {
            return false;
        }
    }
    return true;
}

}  // namespace bdpt
