#include "material/texture.h"

#include "math/elementary.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace bdpt {
namespace {

using DecodeTable = std::array<float, 256>;

/// x^2.4 for x in (0, 1], by Newton's method for the fifth root of x^2; needs no C library.
[[nodiscard]] constexpr double power_2_4(double x)
{
    const double square = x * x;
    double root = 1.0;
    for (int i = 0; i < 40; ++i) {
        const double fourth = root * root * root * root;
        root -= (root * fourth - square) / (5.0 * fourth);
    }
    return square * root;
}

[[nodiscard]] constexpr DecodeTable make_linear()
{
    DecodeTable table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
        table[i] = static_cast<float>(static_cast<double>(i) / 255.0);
    }
    return table;
}

/// The electro-optical function of IEC 61966-2-1.
[[nodiscard]] constexpr DecodeTable make_srgb()
{
    DecodeTable table{};
    for (std::size_t i = 0; i < table.size(); ++i) {
        const double c = static_cast<double>(i) / 255.0;
        const double linear = c <= 0.04045 ? c / 12.92 : power_2_4((c + 0.055) / 1.055);
        table[i] = static_cast<float>(linear);
    }
    return table;
}

constexpr DecodeTable linear_table = make_linear();
constexpr DecodeTable srgb_table = make_srgb();

/// The two texels that a coordinate lies between, and how far it is from the first.
struct Span {
    int first;
    int second;
    float fraction;
};

[[nodiscard]] int floor_to_int(float x)
{
    const int truncated = static_cast<int>(x);
    return truncated - (static_cast<float>(truncated) > x ? 1 : 0);
}

[[nodiscard]] Span span_of(float coordinate, int size, Wrap wrap)
{
    constexpr float limit = 0x1p22f;  // beyond it a float has less than two bits of fraction
    float t = std::abs(coordinate) < limit ? coordinate : 0.0f;
    if (wrap == Wrap::repeat) {
        t -= static_cast<float>(floor_to_int(t));
    } else if (wrap == Wrap::mirrored_repeat) {
        t -= 2.0f * static_cast<float>(floor_to_int(0.5f * t));
        t = t > 1.0f ? 2.0f - t : t;
    } else {
        t = std::clamp(t, 0.0f, 1.0f);
    }
    const float position = t * static_cast<float>(size) - 0.5f;
    const int below = floor_to_int(position);
    const int last = size - 1;
    const float fraction = position - static_cast<float>(below);
    if (wrap == Wrap::repeat) {
        return {below < 0 ? last : std::min(below, last), below >= last ? 0 : below + 1, fraction};
    }
    return {std::clamp(below, 0, last), std::clamp(below + 1, 0, last), fraction};
}

}  // namespace

// KHR_texture_transform scales first, then rotates, then offsets. It turns the coordinates counter-
// clockwise as seen on the picture, whose v points down: its example of the lower left quadrant and
// Khronos's TextureTransformTest agree on that, while the signs in its GLSL listing do not.
Texture::Texture(const TextureRef& ref, const TexelImage& image, Encoding encoding)
    : image_(&image),
      decode_(encoding == Encoding::srgb ? srgb_table.data() : linear_table.data()),
      uv_set_(ref.uv_set),
      wrap_u_(ref.wrap_u),
      wrap_v_(ref.wrap_v),
      offset_(ref.offset)
{
    const SinCos turn = sin_cos(ref.rotation);
    u_axis_ = Vec2{turn.cos, -turn.sin} * ref.scale.x;
    v_axis_ = Vec2{turn.sin, turn.cos} * ref.scale.y;
}

Vec4 Texture::texel(int x, int y) const noexcept
{
    const std::size_t index =
        4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image_->width) +
             static_cast<std::size_t>(x));
    const std::uint8_t* rgba = image_->rgba.data() + index;
    return {decode_[rgba[0]], decode_[rgba[1]], decode_[rgba[2]], linear_table[rgba[3]]};
}

Vec2 Texture::transformed(const std::array<Vec2, 2>& uv) const noexcept
{
    const Vec2 own = uv[static_cast<std::size_t>(uv_set_)];
    return own.x * u_axis_ + own.y * v_axis_ + offset_;
}

Vec2 Texture::texel_position(const std::array<Vec2, 2>& uv) const noexcept
{
    return transformed(uv) * Vec2(image_->width, image_->height);
}

Vec4 Texture::lookup(const std::array<Vec2, 2>& uv) const noexcept
{
    const Vec2 p = transformed(uv);
    const Span x = span_of(p.x, image_->width, wrap_u_);
    const Span y = span_of(p.y, image_->height, wrap_v_);
    const Vec4 upper =
        (1.0f - x.fraction) * texel(x.first, y.first) + x.fraction * texel(x.second, y.first);
    const Vec4 lower =
        (1.0f - x.fraction) * texel(x.first, y.second) + x.fraction * texel(x.second, y.second);
    return (1.0f - y.fraction) * upper + y.fraction * lower;
}

Vec4 Texture::mean() const
{
    std::array<double, 4> sum{};
    for (int y = 0; y < image_->height; ++y) {
        for (int x = 0; x < image_->width; ++x) {
            const Vec4 value = texel(x, y);
            for (int channel = 0; channel < 4; ++channel) {
                sum[static_cast<std::size_t>(channel)] += static_cast<double>(value[channel]);
            }
        }
    }
    const double count = static_cast<double>(image_->width) * static_cast<double>(image_->height);
    return {static_cast<float>(sum[0] / count), static_cast<float>(sum[1] / count),
            static_cast<float>(sum[2] / count), static_cast<float>(sum[3] / count)};
}

std::pair<float, float> Texture::alpha_range() const
{
    std::uint8_t least = 255;
    std::uint8_t greatest = 0;
    for (std::size_t i = 3; i < image_->rgba.size(); i += 4) {
        least = std::min(least, image_->rgba[i]);
        greatest = std::max(greatest, image_->rgba[i]);
    }
    return {linear_table[least], linear_table[greatest]};
}

}  // namespace bdpt
