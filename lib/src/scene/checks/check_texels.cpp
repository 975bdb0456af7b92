#include "scene/checks/validate.h"

#include "scene/checks/value_checks.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace bdpt {
namespace {

/// Tests whether a half or float is finite and not negative, except -0.
[[nodiscard]] bool is_usable(const std::uint8_t* value, TexelType type)
{
    const bool half = type == TexelType::half;
    std::uint32_t bits = 0;
    if (half) {
        std::uint16_t word = 0;
        std::memcpy(&word, value, sizeof word);
        bits = word;
    } else {
        std::memcpy(&bits, value, sizeof bits);
    }
    const std::uint32_t sign = half ? 0x8000U : 0x80000000U;
    const std::uint32_t full_exponent = half ? 0x7c00U : 0x7f800000U;
    const bool negative = (bits & sign) != 0 && bits != sign;
    return !negative && (bits & full_exponent) != full_exponent;
}

}  // namespace

void check_texels(const TexelImage& image, const std::string& item)
{
    if (image.channels < 1 || image.channels > 4) {
        fail(item, ": ", image.channels, " channels, but there must be 1 to 4");
    }
    const std::size_t value_bytes = count_value_bytes(image.type);
    const std::size_t texel_bytes = static_cast<std::size_t>(image.channels) * value_bytes;
    if (image.width < 1 || image.height < 1 ||
        image.bytes.size() != area(image.width, image.height) * texel_bytes) {
        fail(item, ": ", image.width, " x ", image.height, " texels with ", image.bytes.size(),
             " bytes");
    }
    if (image.type != TexelType::half && image.type != TexelType::float32) {
        return;
    }
    for (std::size_t i = 0; i < image.bytes.size(); i += value_bytes) {
        if (!is_usable(image.bytes.data() + i, image.type)) {
            const std::size_t texel = i / texel_bytes;
            const auto columns = static_cast<std::size_t>(image.width);
            fail(item, ": texel (", texel % columns, ", ", texel / columns,
                 ") has a value that is negative or not finite");
        }
    }
}

}  // namespace bdpt
