#include <bdpt/error.h>
#include <bdpt/io/gltf.h>
#include <bdpt/memory/huge_pages.h>
#include <fmt/format.h>

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <utility>

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

bool is_png(ByteView bytes)
{
    return begins_with(bytes, "\x89PNG\r\n\x1a\n");
}

bool is_jpeg(ByteView bytes)
{
    return begins_with(bytes, "\xff\xd8\xff");
}

bool is_webp(ByteView bytes)
{
    return begins_with(bytes, "RIFF") && begins_with(bytes, "WEBP", 8);
}

std::unique_ptr<ImageFile> open(ByteView bytes, Ktx2Decoder* ktx2)
{
    if (is_png(bytes)) {
        return open_png(bytes);
    }
    if (is_jpeg(bytes)) {
        return open_jpeg(bytes);
    }
    if (is_webp(bytes)) {
        return open_webp(bytes);
    }
    if (is_ktx(bytes)) {
        return open_ktx2(bytes, ktx2);
    }
    throw std::runtime_error("neither PNG, JPEG, WebP nor KTX2");
}

}  // namespace

bool is_display_image(ByteView file)
{
    return is_png(file) || is_jpeg(file) || is_webp(file);
}

EncodedImage::EncodedImage(ByteView bytes, const ReadLimits& limits, Ktx2Decoder* ktx2)
    : file_(open(bytes, ktx2))
{
    const TexelImage& layout = file_->layout();
    const std::uint64_t texel_bytes =
        static_cast<std::uint64_t>(layout.channels) * count_value_bytes(layout.type);
    check_image_size(layout.width, layout.height, texel_bytes, limits);
    decoded_bytes_ = static_cast<std::uint64_t>(layout.width) *
                     static_cast<std::uint64_t>(layout.height) * texel_bytes;
}

DecodedImage EncodedImage::decode() &&
{
    DecodedImage decoded{.image = file_->layout()};
    resize_in_huge_pages(decoded.image.bytes, decoded_bytes_);
    file_->read(decoded.image.bytes.data());
    decoded.damage = file_->damage();
    if (const Ktx2Header* const header = file_->ktx2_header()) {
        decoded.remarks = header->remarks;
        decoded.encoding = header->encoding;
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
