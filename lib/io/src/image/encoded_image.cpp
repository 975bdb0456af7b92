#include <bdpt/error.h>
#include <bdpt/io/gltf.h>
#include <bdpt/memory/huge_pages.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string_view>

#include "file/read_file.h"
#include "image/encoded_image.h"

namespace bdpt::io {

void check_image_size(int width, int height, std::uint64_t bytes_per_pixel,
                      const ReadLimits& limits, const MemoryBudget* memory)
{
    if (width > limits.image_side || height > limits.image_side) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("image of {} x {} pixels, but the limit is {} a side", width,
                                height, limits.image_side));
    }
    const std::uint64_t decoded =
        static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) * bytes_per_pixel;
    if (decoded > limits.image_bytes) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("image of {} x {} pixels needs {}, but the limit is {}", width,
                                height, human_bytes(static_cast<long double>(decoded)),
                                human_bytes(static_cast<long double>(limits.image_bytes))));
    }
    if (memory != nullptr) {
        memory->check(fmt::format("image of {} x {} pixels", width, height), decoded);
    }
}

namespace {

bool has(ByteView bytes, std::string_view magic, std::size_t offset = 0)
{
    return bytes.size() >= offset + magic.size() &&
           std::equal(magic.begin(), magic.end(), bytes.subspan(offset).begin(),
                      [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

using ImageFile = std::variant<PngImage, JpegImage, WebpImage, Ktx2Image>;

ImageFile open(ByteView bytes, Ktx2Decoder* ktx2)
{
    if (has(bytes, "\x89PNG\r\n\x1a\n")) {
        return PngImage(bytes);
    }
    if (has(bytes, "\xff\xd8\xff")) {
        return JpegImage(bytes);
    }
    if (has(bytes, "RIFF") && has(bytes, "WEBP", 8)) {
        return WebpImage(bytes);
    }
    if (is_ktx(bytes)) {
        return Ktx2Image(bytes, ktx2);
    }
    throw std::runtime_error("neither PNG, JPEG, WebP nor KTX2");
}

/// Returns the image without its texels.
TexelImage read_layout(const ImageFile& file)
{
    return std::visit(
        [](const auto& image) {
            TexelImage layout{.width = image.width(),
                              .height = image.height(),
                              .bytes = {},
                              .channels = image.channels()};
            layout.type = image.value_bytes() == 2 ? TexelType::unorm16 : TexelType::unorm8;
            return layout;
        },
        file);
}

}  // namespace

EncodedImage::EncodedImage(ByteView bytes, const ReadLimits& limits, Ktx2Decoder* ktx2)
    : file_(open(bytes, ktx2))
{
    const TexelImage layout = read_layout(file_);
    const std::uint64_t texel_bytes =
        static_cast<std::uint64_t>(layout.channels) * count_value_bytes(layout.type);
    check_image_size(layout.width, layout.height, texel_bytes, limits);
    width_ = layout.width;
    height_ = layout.height;
    decoded_bytes_ = static_cast<std::uint64_t>(layout.width) *
                     static_cast<std::uint64_t>(layout.height) * texel_bytes;
}

std::uint64_t EncodedImage::process_memory() const
{
    const auto* const ktx2 = std::get_if<Ktx2Image>(&file_);
    return ktx2 != nullptr ? ktx2->process_memory() : 0;
}

DecodedImage EncodedImage::decode() &&
{
    DecodedImage decoded{.image = read_layout(file_)};
    resize_in_huge_pages(decoded.image.bytes, decoded_bytes_);
    std::visit([&](auto& image) { image.read(decoded.image.bytes.data()); }, file_);
    if (const auto* const jpeg = std::get_if<JpegImage>(&file_)) {
        decoded.damage = jpeg->damage();
    }
    if (const auto* const ktx2 = std::get_if<Ktx2Image>(&file_)) {
        decoded.remarks = ktx2->header().remarks;
        decoded.encoding = ktx2->header().encoding;
    }
    return decoded;
}

DecodedImage decode_texels(ByteView bytes, const ReadLimits& limits)
{
    return EncodedImage(bytes, limits).decode();
}

const TexelImage* ImageCache::find(const ContentHash& encoded) const
{
    const auto found = images_.find({encoded.high, encoded.low});
    return found != images_.end() ? &found->second : nullptr;
}

void ImageCache::keep(const ContentHash& encoded, const TexelImage& image)
{
    if (image.bytes.size() > max_bytes_ - bytes_) {
        return;
    }
    if (images_.try_emplace({encoded.high, encoded.low}, image).second) {
        bytes_ += image.bytes.size();
    }
}

}  // namespace bdpt::io
