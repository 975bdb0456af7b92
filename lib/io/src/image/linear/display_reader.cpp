#include <bdpt/error.h>
#include <bdpt/srgb.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

#include "image/encoded_image.h"
#include "image/linear/image_readers.h"

namespace bdpt::io {

namespace {

/// Returns the linear value of each code.
std::vector<float> linear_values(TexelType type)
{
    const std::size_t codes = type == TexelType::unorm8 ? 256 : 65536;
    std::vector<float> values(codes);
    for (std::size_t code = 0; code < codes; ++code) {
        values[code] = srgb_to_linear(static_cast<double>(code) / static_cast<double>(codes - 1));
    }
    return values;
}

/// Returns value `index` of `texels` as stored.
std::size_t code_at(const TexelImage& texels, std::size_t index)
{
    if (texels.type == TexelType::unorm8) {
        return texels.bytes[index];
    }
    std::uint16_t code = 0;
    std::memcpy(&code, texels.bytes.data() + index * sizeof code, sizeof code);
    return code;
}

Image linear_image(const TexelImage& texels)
{
    const std::vector<float> values = linear_values(texels.type);
    const auto channels = static_cast<std::size_t>(texels.channels);
    const std::size_t green = channels < 3 ? 0 : 1;
    Image image{texels.width, texels.height, {}};
    const std::size_t pixels =
        static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    image.pixels.reserve(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
        const std::size_t first = i * channels;
        image.pixels.emplace_back(values[code_at(texels, first)],
                                  values[code_at(texels, first + green)],
                                  values[code_at(texels, first + 2 * green)]);
    }
    return image;
}

}  // namespace

Image read_display_image(ByteView file, const ReadLimits& limits, Warnings& warnings,
                         const MemoryBudget* memory)
{
    return with_library_errors(ErrorCode::invalid_input, "", [&] {
        EncodedImage encoded(file, limits);
        check_image_size(encoded.width(), encoded.height(), sizeof(Rgb), limits, memory);
        if (memory != nullptr) {
            memory->check("its pixels", 3 * encoded.decoded_bytes());
        }
        const DecodedImage decoded = std::move(encoded).decode();
        if (!decoded.damage.empty()) {
            warnings.add(WarningKind::loss, "the image is damaged", decoded.damage);
        }
        return linear_image(decoded.image);
    });
}

}  // namespace bdpt::io
