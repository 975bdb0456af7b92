#include "light/environment/environment_texels.h"

#include <bdpt/memory/huge_pages.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace bdpt {
namespace {

constexpr float max_half = 65504.0f;

/// Computes approximately the geometric mean of all values that are not zero: the mean of their
/// exponents. A sun does not change it.
class UsualBrightness {
public:
    void add(std::span<const float> values)
    {
        for (const float value : values) {
            const auto exponent =
                static_cast<std::int64_t>(std::bit_cast<std::uint32_t>(value) >> 23U);
            sum_ += exponent;
            count_ += exponent > 0 ? 1 : 0;
        }
    }
    [[nodiscard]] float value() const
    {
        return count_ > 0 ? std::bit_cast<float>(static_cast<std::uint32_t>(sum_ / count_) << 23U)
                          : 0.0f;
    }

private:
    std::int64_t sum_ = 0;
    std::int64_t count_ = 0;
};

}  // namespace

float scale_of_halves(float greatest) noexcept
{
    float scale = 1.0f;
    while (greatest / scale > max_half) {
        scale *= 2.0f;
    }
    while (scale > 0x1p-100f && greatest / (0.5f * scale) <= max_half) {
        scale *= 0.5f;
    }
    return scale;
}

EnvironmentTexels::EnvironmentTexels(const Image& image)
    : width_(image.width), height_(image.height)
{
    static_assert(sizeof(Rgb) == 3 * sizeof(float));
    const auto row = 3 * static_cast<std::size_t>(width_);
    const float* const begin = &image.pixels[0].r;
    store([&](int y) { return std::span(begin + static_cast<std::size_t>(y) * row, row); });
}

EnvironmentTexels::EnvironmentTexels(const EnvironmentTexels& other, float factor)
    : width_(other.width_), height_(other.height_)
{
    std::vector<float> values(3 * static_cast<std::size_t>(width_));
    store([&](int y) {
        for (int x = 0; x < width_; ++x) {
            const Rgb texel = other(x, y) * factor;
            for (int c = 0; c < 3; ++c) {
                values[3 * static_cast<std::size_t>(x) + static_cast<std::size_t>(c)] = texel[c];
            }
        }
        return std::span<const float>(values);
    });
}

EnvironmentTexels::EnvironmentTexels(const Frame& frame, std::vector<std::uint16_t> halves)
    : width_(frame.width),
      height_(frame.height),
      greatest_(frame.greatest),
      scale_(frame.scale),
      halves_(std::move(halves))
{}

void EnvironmentTexels::store(const Rows& rows)
{
    for (int y = 0; y < height_; ++y) {
        for (const float value : rows(y)) {
            greatest_ = std::max(greatest_, value);
        }
    }
    scale_ = scale_of_halves(greatest_);
    if (!encode(rows)) {
        halves_ = {};
        scale_ = 1.0f;
        for (int y = 0; y < height_; ++y) {
            const std::span<const float> values = rows(y);
            floats_.reserve(values.size() * static_cast<std::size_t>(height_));
            floats_.insert(floats_.end(), values.begin(), values.end());
        }
    }
}

/// Encodes the image as half floats; returns false if the error of a texel would exceed 1/2048 of
/// its value and the visible threshold beside texels of usual brightness.
bool EnvironmentTexels::encode(const Rows& rows)
{
    constexpr float relative = 0x1p-11f;
    constexpr float of_usual = 0x1p-16f;
    UsualBrightness usual;
    for (int y = 0; y < height_; ++y) {
        usual.add(rows(y));
    }
    const float unseen = of_usual * usual.value();
    const float inverse = 1.0f / scale_;
    resize_in_huge_pages(halves_,
                         3 * static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));
    std::uint16_t* half = halves_.data();
    for (int y = 0; y < height_; ++y) {
        for (const float value : rows(y)) {
            *half = to_half(value * inverse);
            const float error = std::abs(from_half(*half) * scale_ - value);
            if (error > std::max(relative * value, unseen)) {
                return false;
            }
            ++half;
        }
    }
    return true;
}

}  // namespace bdpt
