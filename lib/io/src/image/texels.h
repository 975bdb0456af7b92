#pragma once

#include "file/bytes.h"
#include "image/oiio_library.h"
#include "image/png_image.h"

#include <bdpt/image.h>
#include <bdpt/io/read_limits.h>

#include <cstdint>
#include <optional>

namespace bdpt::io {

/// A PNG, JPEG or WebP image, told apart by its first bytes, whose size is known and within the
/// limits, and which has not been decoded.
class EncodedImage {
public:
    /// `library` and `bytes` must stay as long as the image. Throws `Error` (invalid_input) when
    /// it is too large, std::runtime_error when it is no such image or broken, so that the caller
    /// may go on without it.
    EncodedImage(const OiioLibrary& library, ByteView bytes, const ReadLimits& limits);

    /// Of the texels, or more. It takes up to twice that while it is decoded.
    [[nodiscard]] std::uint64_t decoded_bytes() const { return decoded_bytes_; }

    /// Texels as they are stored: 8 or 16 bits, one to four channels. Colours are not converted and
    /// alpha is not multiplied in. Throws std::runtime_error when the image is broken. May be
    /// called on another thread, once.
    [[nodiscard]] TexelImage decode() &&;

private:
    const OiioLibrary* library_;
    ByteView bytes_;
    std::optional<PngImage> png_;
    std::optional<OiioImage> opened_;  // none: PNG, or opening it would decode it
    int width_ = 0;
    int height_ = 0;
    std::uint64_t decoded_bytes_ = 0;
};

/// Decodes an image; throws what `EncodedImage` throws.
[[nodiscard]] TexelImage decode_texels(ByteView bytes, const ReadLimits& limits);

}  // namespace bdpt::io
