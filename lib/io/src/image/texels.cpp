#include "image/texels.h"

#include "image/webp_header.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace bdpt::io {

namespace {

bool starts_with(ByteView bytes, std::string_view magic)
{
    return bytes.size() >= magic.size() &&
           std::equal(magic.begin(), magic.end(), bytes.begin(),
                      [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
}

bool is_png(ByteView bytes)
{
    return starts_with(bytes, "\x89PNG\r\n\x1a\n");
}

/// OpenImageIO's name of the format.
const char* find_format(ByteView bytes)
{
    if (starts_with(bytes, "\xff\xd8\xff")) {
        return "jpeg";
    }
    if (is_webp(bytes)) {
        return "webp";
    }
    if (starts_with(bytes, "\xabKTX")) {
        throw std::runtime_error("KTX images are not supported");
    }
    throw std::runtime_error("neither PNG, JPEG nor WebP");
}

/// Reads all values of type T into the bytes of `image`.
template <typename T>
void read_values(const OiioImage& oiio_image, TexelImage& image)
{
    image.bytes.resize(oiio_image.value_count() * sizeof(T));
    if constexpr (sizeof(T) == 1) {
        oiio_image.read(image.bytes.data());
    } else {
        // A vector of bytes is allocated for any type, and nobody reads the words as such.
        oiio_image.read(reinterpret_cast<T*>(image.bytes.data()));
    }
}

}  // namespace

EncodedImage::EncodedImage(const OiioLibrary& library, ByteView bytes, const ReadLimits& limits)
    : library_(&library), bytes_(bytes)
{
    std::uint64_t texel_bytes = 4;
    if (is_webp(bytes)) {
        const EncodedImageSize size = webp_size(bytes);
        width_ = size.width;
        height_ = size.height;
    } else if (is_png(bytes)) {
        png_.emplace(bytes);
        width_ = png_->width();
        height_ = png_->height();
        texel_bytes = static_cast<std::uint64_t>(png_->channels() * png_->value_bytes());
    } else {
        opened_.emplace(library.open(find_format(bytes), bytes));
        const BdptImageHeader& header = opened_->header();
        width_ = header.width;
        height_ = header.height;
        texel_bytes =
            static_cast<std::uint64_t>(header.channels) * (header.value_bytes == 2 ? 2 : 1);
    }
    check_image_size(width_, height_, texel_bytes, bytes.size(), limits);
    decoded_bytes_ =
        static_cast<std::uint64_t>(width_) * static_cast<std::uint64_t>(height_) * texel_bytes;
}

TexelImage EncodedImage::decode() &&
{
    if (png_) {
        TexelImage image{
            .width = width_, .height = height_, .bytes = {}, .channels = png_->channels()};
        image.type = png_->value_bytes() == 2 ? TexelType::unorm16 : TexelType::unorm8;
        image.bytes.resize(decoded_bytes_);
        png_->read(image.bytes.data());
        return image;
    }
    const OiioImage oiio_image =
        opened_ ? std::move(*opened_) : library_->open(find_format(bytes_), bytes_);
    const BdptImageHeader& header = oiio_image.header();
    if (header.width != width_ || header.height != height_) {
        throw std::runtime_error(fmt::format("{} x {} pixels, but {} x {} by the header",
                                             header.width, header.height, width_, height_));
    }
    if (header.channels > 4) {
        throw std::runtime_error(fmt::format("{} channels", header.channels));
    }
    TexelImage image{
        .width = header.width, .height = header.height, .bytes = {}, .channels = header.channels};
    if (header.value_bytes == 2) {
        image.type = TexelType::unorm16;
        read_values<std::uint16_t>(oiio_image, image);
    } else {
        read_values<std::uint8_t>(oiio_image, image);
    }
    return image;
}

TexelImage decode_texels(ByteView bytes, const ReadLimits& limits)
{
    const OiioLibrary library;
    return EncodedImage(library, bytes, limits).decode();
}

}  // namespace bdpt::io
