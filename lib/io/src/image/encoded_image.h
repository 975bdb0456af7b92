#pragma once

#include <bdpt/image.h>
#include <bdpt/io/read_limits.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "file/read_file.h"

namespace bdpt::io {

/// Refuses images beyond the limits, by their headers. `bytes_per_pixel` is that of the decoded
/// image. There is no limit on the compression ratio: a dark image may legitimately shrink a
/// thousandfold. Throws as `memory` does if that does not have the bytes. Throws `Error`
/// (invalid_input).
void check_image_size(int width, int height, std::uint64_t bytes_per_pixel,
                      const ReadLimits& limits, const MemoryBudget* memory = nullptr);

/// A JPEG file in memory whose header has been read: baseline or progressive, 8 bits a channel,
/// grey, RGB, YCbCr, CMYK or YCCK. Decoded by libjpeg.
class JpegImage {
public:
    /// `bytes` must outlive the image. Throws std::runtime_error if the header is broken, or
    /// describes another kind of image.
    explicit JpegImage(ByteView bytes);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    /// Returns 1: grey, or 3: RGB, to which all other kinds are converted.
    [[nodiscard]] int channels() const { return channels_; }
    [[nodiscard]] static constexpr int value_bytes() { return 1; }

    /// Decodes all pixels, top row first, into room for width * height * channels values; called
    /// once. Throws std::runtime_error if nothing can be decoded, or not with reasonable work.
    void read(std::uint8_t* values);

    /// Returns the first damage that libjpeg reports for data that could be decoded anyway, as far
    /// as it has been read. Empty: none. Where data is missing, pixels are guessed or grey.
    [[nodiscard]] std::string damage() const;

private:
    struct State;
    struct Close {
        void operator()(State* state) const;
    };

    std::unique_ptr<State, Close> state_;
    int width_ = 0;
    int height_ = 0;
    int channels_ = 0;
};

/// A PNG file in memory whose header has been read. Decoded by libpng.
class PngImage {
public:
    /// `bytes` must outlive the image. Throws std::runtime_error if the header is broken.
    explicit PngImage(ByteView bytes);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    /// Returns 1: grey, 2: grey and alpha, 3: RGB, 4: RGBA. Palettes and a transparent colour are
    /// resolved.
    [[nodiscard]] int channels() const { return channels_; }
    /// Returns 1 or 2; fewer bits are scaled to 8.
    [[nodiscard]] int value_bytes() const { return value_bytes_; }

    /// Decodes all pixels, top row first, into room for width * height * channels values, integers
    /// in native byte order; called once. Colours are not converted, alpha is not premultiplied.
    /// Throws std::runtime_error if the file is broken.
    void read(std::uint8_t* values);

private:
    struct State;
    struct Close {
        void operator()(State* state) const;
    };

    std::unique_ptr<State, Close> state_;
    int width_ = 0;
    int height_ = 0;
    int channels_ = 0;
    int value_bytes_ = 0;
};

/// A WebP file in memory whose header has been read [RFC 9649]: lossy or lossless, with or without
/// alpha. Of an animation only the first frame is read. Decoded by libwebp.
class WebpImage {
public:
    /// `bytes` must outlive the image. Throws std::runtime_error if the header is broken, or the
    /// file is truncated.
    explicit WebpImage(ByteView bytes);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    /// Returns 3: RGB, or 4: RGBA.
    [[nodiscard]] int channels() const { return channels_; }
    [[nodiscard]] static constexpr int value_bytes() { return 1; }

    /// Decodes all pixels, top row first, into room for width * height * channels values, which are
    /// all 0; called once. Alpha is not premultiplied. Pixels outside the frame of an animation
    /// stay 0. Throws std::runtime_error if the file is broken.
    void read(std::uint8_t* values);

private:
    struct State;
    struct Close {
        void operator()(State* state) const;
    };

    std::unique_ptr<State, Close> state_;
    int width_ = 0;
    int height_ = 0;
    int channels_ = 0;
};

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

/// Returns the memory that a process may take to decode the image in `file` [bytes].
[[nodiscard]] std::uint64_t decoding_memory(ByteView file, const Ktx2Header& header);

/// libktx of Khronos, opened by the program bdpt-read-ktx in a separate process for each image: a
/// file that crashes it costs only one image.
class Ktx2Decoder {
public:
    /// `library` is a file or a folder with libktx.so.4; none: the library that the system finds by
    /// that name. Nothing is opened yet.
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

/// A KTX2 file in memory whose header has been checked.
class Ktx2Image {
public:
    /// `bytes` and `decoder` must outlive the image; null: there is no decoder. Throws
    /// std::runtime_error if the header is broken, or nothing decodes the image.
    Ktx2Image(ByteView bytes, Ktx2Decoder* decoder);

    [[nodiscard]] const Ktx2Header& header() const { return header_; }
    [[nodiscard]] int width() const { return header_.width; }
    [[nodiscard]] int height() const { return header_.height; }
    /// Returns 3: RGB, or 4: RGBA.
    [[nodiscard]] int channels() const { return header_.channels; }
    [[nodiscard]] static constexpr int value_bytes() { return 1; }

    /// Returns the memory that another process may take to decode it [bytes].
    [[nodiscard]] std::uint64_t process_memory() const { return decoding_memory(bytes_, header_); }

    /// Decodes all pixels, top row first, into room for width * height * channels values. Throws as
    /// `Ktx2Decoder::decode`.
    void read(std::uint8_t* values);

private:
    ByteView bytes_;
    Ktx2Decoder* decoder_;
    Ktx2Header header_;
};

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
