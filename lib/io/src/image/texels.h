#pragma once

#include "file/bytes.h"
#include "image/jpeg_image.h"
#include "image/ktx2_image.h"
#include "image/png_image.h"
#include "image/webp_image.h"

#include <bdpt/image.h>
#include <bdpt/io/read_limits.h>

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace bdpt::io {

/// A decoded image.
struct DecodedImage {
    TexelImage image{};
    std::string damage{};  ///< damage of a file that could be decoded anyway; or empty
    /// Violations of the format in a file that could be decoded completely.
    std::vector<std::string> remarks{};
    ColorEncoding encoding = ColorEncoding::unknown;  ///< as stated in the file
};

/// A PNG, JPEG, WebP or KTX2 image, recognized by its first bytes, whose size is known and within
/// the limits, and which has not been decoded.
class EncodedImage {
public:
    /// `bytes` and `ktx2` must outlive the image; null: KTX2 is not decoded. Throws `Error`
    /// (invalid_input) if it is too large, std::runtime_error if it is no such image or broken, so
    /// that the caller may go on without it.
    EncodedImage(ByteView bytes, const ReadLimits& limits, Ktx2Decoder* ktx2 = nullptr);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    /// Returns the size of the texels. Decoding takes up to three times as much.
    [[nodiscard]] std::uint64_t decoded_bytes() const { return decoded_bytes_; }

    /// Returns the memory that another process may take to decode it [bytes]; 0: there is none.
    [[nodiscard]] std::uint64_t process_memory() const;

    /// Decodes texels as stored: 8 or 16 bits, one to four channels. Colours are not converted and
    /// alpha is not premultiplied. Throws std::runtime_error if the image is broken. May be called
    /// on another thread, once.
    [[nodiscard]] DecodedImage decode() &&;

private:
    std::variant<PngImage, JpegImage, WebpImage, Ktx2Image> file_;
    int width_ = 0;
    int height_ = 0;
    std::uint64_t decoded_bytes_ = 0;
};

/// Decodes an image; throws as `EncodedImage`.
[[nodiscard]] DecodedImage decode_texels(ByteView bytes, const ReadLimits& limits);

}  // namespace bdpt::io
