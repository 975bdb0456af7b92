#include "texture/texture.h"

#include "math/elementary.h"

#include <bdpt/memory/huge_pages.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace bdpt {
namespace {

/// The texels of a row or column that a texel of the copy covers, with their weights.
struct Taps {
    int first = 0;
    int count = 0;
    std::array<float, 4> shares{};
};

[[nodiscard]] std::vector<Taps> make_taps(int size, int smaller)
{
    std::vector<Taps> all;
    const double width = static_cast<double>(size) / smaller;
    for (int i = 0; i < smaller; ++i) {
        const double begin = i * width;
        const double end = std::min<double>(size, (i + 1) * width);
        Taps taps{.first = static_cast<int>(begin)};
        for (int at = taps.first; at < size && at < end && taps.count < 4; ++at) {
            const double covered = std::min<double>(at + 1, end) - std::max<double>(at, begin);
            taps.shares[static_cast<std::size_t>(taps.count++)] =
                static_cast<float>(covered / width);
        }
        all.push_back(taps);
    }
    return all;
}

/// Returns the index of the nearest value in an ascending table.
[[nodiscard]] std::size_t nearest(const float* table, std::size_t count, float value)
{
    const auto above =
        static_cast<std::size_t>(std::lower_bound(table, table + count, value) - table);
    if (above == 0 || above == count) {
        return above == 0 ? 0 : count - 1;
    }
    return value - table[above - 1] < table[above] - value ? above - 1 : above;
}

[[nodiscard]] std::size_t to_integer(float value, const float* table, std::size_t most)
{
    return table != nullptr ? nearest(table, most + 1, value)
                            : static_cast<std::size_t>(
                                  std::clamp(value, 0.0f, 1.0f) * static_cast<float>(most) + 0.5f);
}

template <TexelType type>
void store(std::uint8_t* to, float value, const float* table)
{
    if constexpr (type == TexelType::unorm8) {
        *to = static_cast<std::uint8_t>(to_integer(value, table, 255));
    } else if constexpr (type == TexelType::unorm16) {
        const auto word = static_cast<std::uint16_t>(to_integer(value, table, 65535));
        std::memcpy(to, &word, sizeof word);
    } else if constexpr (type == TexelType::half) {
        const std::uint16_t word = glm::packHalf1x16(value);
        std::memcpy(to, &word, sizeof word);
    } else {
        std::memcpy(to, &value, sizeof value);
    }
}

template <TexelType type, int channels>
void store_texel(std::uint8_t* to, Vec4 value, const float* table)
{
    constexpr int colors = channels < 3 ? 1 : 3;
    for (int c = 0; c < colors; ++c) {
        store<type>(to + static_cast<std::size_t>(c) * count_value_bytes(type), value[c], table);
    }
    if constexpr (channels == 2 || channels == 4) {
        store<type>(to + static_cast<std::size_t>(colors) * count_value_bytes(type), value.w,
                    nullptr);
    }
}

}  // namespace

TexelImage half_size(const TexelImage& image, Encoding encoding, const ForRows& for_rows)
{
    TexelImage copy{.width = std::max(1, image.width / 2),
                    .height = std::max(1, image.height / 2),
                    .bytes = {},
                    .channels = image.channels,
                    .type = image.type};
    const std::size_t texel_bytes =
        static_cast<std::size_t>(image.channels) * count_value_bytes(image.type);
    const auto row_length = static_cast<std::size_t>(copy.width);
    resize_in_huge_pages(copy.bytes,
                         row_length * static_cast<std::size_t>(copy.height) * texel_bytes);
    const std::vector<Taps> columns = make_taps(image.width, copy.width);
    const std::vector<Taps> rows = make_taps(image.height, copy.height);
    // Values above 1 are kept: lookups decide how they are clamped.
    const TexelCoding coding{.table = find_coding(image.type, encoding).table,
                             .most = find_coding(image.type, Encoding::radiance).most};
    const float* curve = encoding == Encoding::linear ? nullptr : coding.table;
    const auto average_rows = [&]<TexelType type, int channels>() {
        const TexelReader<type, channels> texel(image.bytes.data(), coding);
        for_rows(copy.height, [&](int begin, int end) {
            for (int y = begin; y < end; ++y) {
                const Taps& down = rows[static_cast<std::size_t>(y)];
                for (std::size_t x = 0; x < row_length; ++x) {
                    const Taps& across = columns[x];
                    Vec4 sum(0.0f);
                    for (int j = 0; j < down.count; ++j) {
                        const std::size_t start = static_cast<std::size_t>(down.first + j) *
                                                      static_cast<std::size_t>(image.width) +
                                                  static_cast<std::size_t>(across.first);
                        Vec4 row(0.0f);
                        for (std::size_t i = 0; i < static_cast<std::size_t>(across.count); ++i) {
                            row += across.shares[i] * texel(start + i);
                        }
                        sum += down.shares[static_cast<std::size_t>(j)] * row;
                    }
                    const std::size_t to = static_cast<std::size_t>(y) * row_length + x;
                    store_texel<type, channels>(copy.bytes.data() + to * texel_bytes, sum, curve);
                }
            }
        });
    };
    with_layout(image.type, image.channels, average_rows);
    return copy;
}

std::span<const TexelImage> MipMaps::of(std::size_t index, const TexelImage& image,
                                        Encoding encoding)
{
    auto& copies = copies_[{index, encoding}];
    if (!copies) {
        std::vector<TexelImage> levels;
        const TexelImage* finer = &image;
        while (finer->width > 1 || finer->height > 1) {
            levels.push_back(half_size(*finer, encoding, for_rows_));
            finer = &levels.back();
        }
        copies = std::make_shared<const std::vector<TexelImage>>(std::move(levels));
    }
    return *copies;
}

namespace {

/// The two texels adjacent to a coordinate, and the fraction between them.
struct Span {
    int first;
    int second;
    float fraction;
};

[[nodiscard]] Span find_span(float coordinate, int size, Wrap wrap)
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

// KHR_texture_transform scales first, then rotates, then offsets. It rotates the coordinates
// counter-clockwise as seen on the image, whose v points down: its example of the lower left
// quadrant and Khronos's TextureTransformTest agree on that, while the signs in its GLSL listing do
// not.
Texture::Texture(const TextureRef& ref, const TexelImage& image, Encoding encoding,
                 std::span<const TexelImage> coarser)
    : image_(&image),
      coarser_(coarser),
      coding_(find_coding(image.type, encoding)),
      uv_set_(ref.uv_set),
      wrap_u_(ref.wrap_u),
      wrap_v_(ref.wrap_v),
      offset_(ref.offset)
{
    const SinCos turn = sin_cos(ref.rotation);
    u_axis_ = Vec2{turn.cos, -turn.sin} * ref.scale.x;
    v_axis_ = Vec2{turn.sin, turn.cos} * ref.scale.y;
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

const TexelImage& Texture::level(const UvFootprint& footprint) const noexcept
{
    const UvSteps& pixel = footprint[static_cast<std::size_t>(uv_set_)];
    const Vec2 size(image_->width, image_->height);
    const Vec2 along = (pixel.along.x * u_axis_ + pixel.along.y * v_axis_) * size;
    const Vec2 across = (pixel.across.x * u_axis_ + pixel.across.y * v_axis_) * size;
    // The squared smaller singular value of the matrix with these columns: the footprint's
    // narrowest width in texels.
    const float sum = dot(along, along) + dot(across, across);
    const float area = along.x * across.y - along.y * across.x;
    const float root = std::sqrt(std::max(0.0f, sum * sum - 4.0f * area * area));
    const float width_squared = 2.0f * area * area / (sum + root);
    constexpr float two_levels = 16.0f;  // four texels: two of the next level, half of the width
    if (!(width_squared >= two_levels)) {
        return *image_;  // also if coordinates do not change, or not finitely
    }
    const int exponent = static_cast<int>(std::bit_cast<std::uint32_t>(width_squared) >> 23U) - 127;
    const auto halvings = static_cast<std::size_t>(exponent / 2 - 1);
    return coarser_[std::min(halvings, coarser_.size()) - 1];
}

Vec4 Texture::bilinear(const TexelImage& image, const std::array<Vec2, 2>& uv) const noexcept
{
    const Vec2 p = transformed(uv);
    const Span x = find_span(p.x, image.width, wrap_u_);
    const Span y = find_span(p.y, image.height, wrap_v_);
    const auto width = static_cast<std::size_t>(image.width);
    const std::size_t first_row = static_cast<std::size_t>(y.first) * width;
    const std::size_t second_row = static_cast<std::size_t>(y.second) * width;
    const auto first = static_cast<std::size_t>(x.first);
    const auto second = static_cast<std::size_t>(x.second);
    return with_layout(image.type, image.channels, [&]<TexelType type, int channels>() {
        const TexelReader<type, channels> texel(image.bytes.data(), coding_);
        const Vec4 upper =
            (1.0f - x.fraction) * texel(first_row + first) + x.fraction * texel(first_row + second);
        const Vec4 lower = (1.0f - x.fraction) * texel(second_row + first) +
                           x.fraction * texel(second_row + second);
        return (1.0f - y.fraction) * upper + y.fraction * lower;
    });
}

void Texture::prefetch(const std::array<Vec2, 2>& uv) const noexcept
{
    constexpr std::size_t bytes_of_cache = std::size_t{1} << 18U;  // of a core, for textures
    const TexelImage& image = *image_;
    if (image.bytes.size() < bytes_of_cache) {
        return;
    }
    const Vec2 p = transformed(uv);
    const auto x = static_cast<std::size_t>(find_span(p.x, image.width, wrap_u_).first);
    const Span y = find_span(p.y, image.height, wrap_v_);
    const std::size_t texel_bytes =
        static_cast<std::size_t>(image.channels) * count_value_bytes(image.type);
    for (const int row : {y.first, y.second}) {
        const std::size_t texel =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) + x;
        __builtin_prefetch(&image.bytes[texel * texel_bytes]);
    }
}

template <typename Visit>
void Texture::for_each_texel(const Visit& visit) const
{
    const std::size_t count =
        static_cast<std::size_t>(image_->width) * static_cast<std::size_t>(image_->height);
    with_layout(image_->type, image_->channels, [&]<TexelType type, int channels>() {
        const TexelReader<type, channels> texel(image_->bytes.data(), coding_);
        for (std::size_t i = 0; i < count; ++i) {
            visit(texel(i));
        }
    });
}

Vec4 Texture::mean() const
{
    std::array<double, 4> sum{};
    for_each_texel([&sum](Vec4 value) {
        for (int channel = 0; channel < 4; ++channel) {
            sum[static_cast<std::size_t>(channel)] += static_cast<double>(value[channel]);
        }
    });
    const double count = static_cast<double>(image_->width) * static_cast<double>(image_->height);
    return {static_cast<float>(sum[0] / count), static_cast<float>(sum[1] / count),
            static_cast<float>(sum[2] / count), static_cast<float>(sum[3] / count)};
}

std::pair<float, float> Texture::alpha_range() const
{
    float least = 1.0f;
    float greatest = 0.0f;
    for_each_texel([&](Vec4 value) {
        least = std::min(least, value.w);
        greatest = std::max(greatest, value.w);
    });
    return {least, greatest};
}

}  // namespace bdpt
