#pragma once

#include <bdpt/image.h>
#include <bdpt/types.h>

#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace bdpt {

/// Encoding of an image's red, green and blue; alpha is always linear.
enum class Encoding : std::uint8_t {
    linear,
    srgb,      ///< sRGB integers; halves and floats are linear
    radiance,  ///< as `srgb`, and halves and floats may exceed 1
};

/// Decoding of stored values.
struct TexelCoding {
    const float* table = nullptr;  ///< decoded integers; null: linear 16 bits, or not integers
    float most = 1.0f;             ///< upper bound to which halves and floats are clamped
};

/// Returns the decoding of a type. Tables stay valid until the end of the process.
[[nodiscard]] TexelCoding find_coding(TexelType type, Encoding encoding);

/// Returns the table of linear 8-bit values, such as alpha.
[[nodiscard]] const float* linear_table_8() noexcept;

/// Reads texels of one type and number of channels (1 to 4) as linear RGBA.
template <TexelType type, int channels>
class TexelReader {
public:
    /// `bytes` are those of the image.
    TexelReader(const std::uint8_t* bytes, const TexelCoding& coding)
        : bytes_(bytes), coding_(coding)
    {}

    [[nodiscard]] Vec4 operator()(std::size_t index) const noexcept
    {
        const std::uint8_t* texel = bytes_ + index * channels * count_value_bytes(type);
        if constexpr (channels < 3) {
            const float grey = color(texel, 0);
            return {grey, grey, grey, channels == 2 ? alpha(texel, 1) : 1.0f};
        } else {
            return {color(texel, 0), color(texel, 1), color(texel, 2),
                    channels == 4 ? alpha(texel, 3) : 1.0f};
        }
    }

private:
    template <typename Value>
    [[nodiscard]] static Value load(const std::uint8_t* texel, std::size_t channel) noexcept
    {
        Value value;
        std::memcpy(&value, texel + channel * sizeof(Value), sizeof(Value));
        return value;
    }

    [[nodiscard]] float color(const std::uint8_t* texel, std::size_t channel) const noexcept
    {
        if constexpr (type == TexelType::unorm8) {
            return coding_.table[texel[channel]];
        } else if constexpr (type == TexelType::unorm16) {
            const auto value = load<std::uint16_t>(texel, channel);
            return coding_.table != nullptr ? coding_.table[value] : linear_16(value);
        } else {
            return std::min(wide(texel, channel), coding_.most);
        }
    }

    [[nodiscard]] float alpha(const std::uint8_t* texel, std::size_t channel) const noexcept
    {
        if constexpr (type == TexelType::unorm8) {
            return linear_table_8()[texel[channel]];
        } else if constexpr (type == TexelType::unorm16) {
            return linear_16(load<std::uint16_t>(texel, channel));
        } else {
            return std::min(wide(texel, channel), 1.0f);
        }
    }

    [[nodiscard]] static float linear_16(std::uint16_t value) noexcept
    {
        return static_cast<float>(value) / 65535.0f;
    }

    [[nodiscard]] static float wide(const std::uint8_t* texel, std::size_t channel) noexcept
    {
        if constexpr (type == TexelType::half) {
            return glm::unpackHalf1x16(load<std::uint16_t>(texel, channel));
        } else {
            return load<float>(texel, channel);
        }
    }

    const std::uint8_t* bytes_;
    TexelCoding coding_;
};

/// Calls `work` with the template arguments <type, channels> of the image.
template <typename Work>
decltype(auto) with_layout(TexelType type, int channels, const Work& work)
{
    const auto with_channels = [&]<TexelType known>() -> decltype(auto) {
        switch (channels) {
            case 1:
                return work.template operator()<known, 1>();
            case 2:
                return work.template operator()<known, 2>();
            case 3:
                return work.template operator()<known, 3>();
            default:
                return work.template operator()<known, 4>();
        }
    };
    if (type == TexelType::unorm8) [[likely]] {
        return with_channels.template operator()<TexelType::unorm8>();
    }
    if (type == TexelType::unorm16) {
        return with_channels.template operator()<TexelType::unorm16>();
    }
    return type == TexelType::half ? with_channels.template operator()<TexelType::half>()
                                   : with_channels.template operator()<TexelType::float32>();
}

}  // namespace bdpt
