#pragma once

#include <bdpt/image.h>
#include <bdpt/io/read_limits.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "file/read_file.h"

namespace bdpt::io {

/// Refuses images beyond the limits, by their headers. `bytes_per_pixel` is that of the decoded
/// image. There is no limit on the compression ratio: a dark image may legitimately shrink a
/// thousandfold. Throws as `memory` does if that does not have the bytes. Throws `Error`
/// (invalid_input).
void check_image_size(int width, int height, std::uint64_t bytes_per_pixel,
                      const ReadLimits& limits, const MemoryBudget* memory = nullptr);

/// Colour encoding that the image states; glTF uses the encoding of the texture's purpose.
enum class ColorEncoding : std::uint8_t { unknown, linear, srgb };

/// Header of a KTX2 image that a texture may have [KTX File Format Specification 2.0;
/// KHR_texture_basisu]: 2D, ETC1S, UASTC, or 8-bit RGB or RGBA.
struct Ktx2Header {
    int width = 0;     ///< >= 1
    int height = 0;    ///< >= 1
    int channels = 0;  ///< 3: RGB, 4: RGBA
    ColorEncoding encoding = ColorEncoding::unknown;
    std::uint64_t pixels = 0;  ///< sum over all levels
    /// Violations of KHR_texture_basisu that do not prevent decoding.
    std::vector<std::string> remarks;
};

/// Tests whether a file begins like KTX files of some version.
[[nodiscard]] bool is_ktx(ByteView bytes);

/// Checks all offsets and sizes before a library sees the file. Throws std::runtime_error if the
/// file is broken, or is no image that a texture may have.
[[nodiscard]] Ktx2Header read_ktx2_header(ByteView bytes);

/// libktx of Khronos, opened by the program bdpt-read-ktx in a separate process for each image: a
/// file that crashes it costs only one image.
class Ktx2Decoder {
public:
    /// `library` is a file or a folder with libktx.so.4; none: ktx/libktx.so beside bdpt::io, else
    /// the library that the system finds by that name. Nothing is opened yet.
    explicit Ktx2Decoder(const std::optional<std::filesystem::path>& library);

    /// Returns why no image can be decoded; null: images can. The first call starts a process to
    /// find out.
    [[nodiscard]] const std::string* obstacle();

    /// Decodes the first level into room for width * height * channels bytes, top row first.
    /// Thread-safe. Throws std::runtime_error if the file is broken, `Error` (out_of_memory) if the
    /// system has no room for a process.
    void decode(ByteView file, const Ktx2Header& header, std::uint8_t* texels) const;

private:
    std::string library_;  // empty: the one that the system finds
    bool is_known_ = false;
    std::optional<std::string> obstacle_;
};

/// An image file in memory whose header has been read. The bytes must outlive it.
class ImageFile {
public:
    virtual ~ImageFile() = default;
    ImageFile(const ImageFile&) = delete;
    ImageFile& operator=(const ImageFile&) = delete;

    /// Returns size, channels and type of the texels, without their bytes.
    [[nodiscard]] const TexelImage& layout() const { return layout_; }

    /// Decodes all pixels, top row first, into room for all values, which are 0: integers in native
    /// byte order. Called once. Colours are not converted, alpha is not premultiplied. Throws
    /// std::runtime_error if the file is broken, or takes more than reasonable work.
    virtual void read(std::uint8_t* values) = 0;

    /// Returns the first damage of data that could be decoded anyway, as far as it has been read.
    /// Empty: none. Where data is missing, pixels are guessed or grey.
    [[nodiscard]] virtual std::string damage() const { return {}; }
    /// Returns the header of a KTX2 file; null for others.
    [[nodiscard]] virtual const Ktx2Header* ktx2_header() const { return nullptr; }
    /// Returns the memory that another process may take to decode it [bytes]; 0: there is none.
    [[nodiscard]] virtual std::uint64_t process_memory() const { return 0; }

protected:
    ImageFile() = default;

    TexelImage layout_;
};

// Each throws std::runtime_error if the header is broken, or describes another kind of image.

/// Opens a JPEG file with libjpeg: baseline or progressive, 8 bits a channel, grey, RGB, YCbCr,
/// CMYK or YCCK. Texels are grey or RGB, to which all other kinds are converted.
[[nodiscard]] std::unique_ptr<ImageFile> open_jpeg(ByteView bytes);
/// Opens a PNG file with libpng. Palettes and a transparent colour are resolved, fewer bits than 8
/// are scaled to 8.
[[nodiscard]] std::unique_ptr<ImageFile> open_png(ByteView bytes);
/// Opens a WebP file with libwebp [RFC 9649]: lossy or lossless, with or without alpha. Of an
/// animation only the first frame is read; pixels outside of it stay 0.
[[nodiscard]] std::unique_ptr<ImageFile> open_webp(ByteView bytes);
/// Opens a KTX2 file. `decoder` must outlive it; null: there is none, which is an error.
[[nodiscard]] std::unique_ptr<ImageFile> open_ktx2(ByteView bytes, Ktx2Decoder* decoder);

/// Tests whether a file is PNG, JPEG or WebP, by its first bytes.
[[nodiscard]] bool is_display_image(ByteView file);

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

    [[nodiscard]] int width() const { return file_->layout().width; }
    [[nodiscard]] int height() const { return file_->layout().height; }
    /// Returns the size of the texels. Decoding takes up to three times as much.
    [[nodiscard]] std::uint64_t decoded_bytes() const { return decoded_bytes_; }

    /// Returns the memory that another process may take to decode it [bytes]; 0: there is none.
    [[nodiscard]] std::uint64_t process_memory() const { return file_->process_memory(); }

    /// Decodes texels as stored: 8 or 16 bits, one to four channels. Colours are not converted and
    /// alpha is not premultiplied. Throws std::runtime_error if the image is broken. May be called
    /// on another thread, once.
    [[nodiscard]] DecodedImage decode() &&;

private:
    std::unique_ptr<ImageFile> file_;
    std::uint64_t decoded_bytes_ = 0;
};

/// Decodes an image; throws as `EncodedImage`.
[[nodiscard]] DecodedImage decode_texels(ByteView bytes, const ReadLimits& limits);

}  // namespace bdpt::io
