#include "texture/mip_maps.h"

#include "texture/texel_access.h"

#include <bdpt/memory/huge_pages.h>

#include <algorithm>
#include <array>
#include <cmath>

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

}  // namespace bdpt
