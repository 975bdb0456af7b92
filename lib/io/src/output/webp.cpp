#include <bdpt/io/write_image.h>

#include <bdpt/error.h>
#include <bdpt/io/output_file.h>
#include <fmt/core.h>
#include <webp/encode.h>

#include <cstddef>
#include <cstdint>
#include <new>
#include <string>
#include <string_view>

#include "output/image_output.h"

namespace bdpt::io {
namespace {

/// State of libwebp.
struct WebpEncoder {
    WebPPicture picture{};
    WebPMemoryWriter bytes{};

    WebpEncoder() { WebPMemoryWriterInit(&bytes); }
    WebpEncoder(const WebpEncoder&) = delete;
    WebpEncoder& operator=(const WebpEncoder&) = delete;
    ~WebpEncoder()
    {
        WebPPictureFree(&picture);
        WebPMemoryWriterClear(&bytes);
    }

    /// Returns true on success; else `picture` has the error.
    [[nodiscard]] bool encode(const TexelImage& image)
    {
        constexpr float quality = 95.0f;
        WebPConfig config;
        if (WebPPictureInit(&picture) == 0 ||
            WebPConfigPreset(&config, WEBP_PRESET_DEFAULT, quality) == 0) {
            picture.error_code = VP8_ENC_ERROR_INVALID_CONFIGURATION;
            return false;
        }
        config.use_sharp_yuv = 1;  // keeps edges of saturated colours sharp
        config.exact = 1;
        picture.use_argb = 1;
        picture.width = image.width;
        picture.height = image.height;
        picture.writer = &WebPMemoryWrite;
        picture.custom_ptr = &bytes;
        const int stride = image.width * image.channels;
        const int imported = image.channels == 4
                                 ? WebPPictureImportRGBA(&picture, image.bytes.data(), stride)
                                 : WebPPictureImportRGB(&picture, image.bytes.data(), stride);
        return imported != 0 && WebPEncode(&config, &picture) != 0;
    }
};

void append_number(std::string& bytes, std::uint32_t number, int size)
{
    for (int i = 0; i < size; ++i) {
        bytes += static_cast<char>(number >> 8 * i);
    }
}

void append_chunk(std::string& bytes, std::string_view type, std::string_view data)
{
    bytes += type;
    append_number(bytes, static_cast<std::uint32_t>(data.size()), 4);
    bytes += data;
    bytes.append(data.size() % 2, '\0');
}

/// Returns the metadata as Exif's description of the image.
std::string make_exif(const PngOptions& options)
{
    std::string text;
    for (const auto& [name, value] : picture_text(options)) {
        text += fmt::format("{}: {}\n", name, value);
    }
    text += '\0';
    std::string exif("II*\0\x08\0\0\0\x01\0", 10);  // one entry at byte 8 [TIFF 6.0, section 2]
    append_number(exif, 0x010e, 2);                 // ImageDescription
    append_number(exif, 2, 2);                      // ASCII
    append_number(exif, static_cast<std::uint32_t>(text.size()), 4);
    append_number(exif, 26, 4);  // the place of the text, after:
    append_number(exif, 0, 4);   // no further directory
    return exif + text;
}

/// Returns an encoded image with metadata, in the extended format [RFC 9649, section 2.7].
std::string with_exif(std::string_view encoded, const TexelImage& image, const PngOptions& options)
{
    constexpr char has_exif = 0x08;
    constexpr std::size_t head = 12;  // "RIFF", its size, "WEBP"
    constexpr std::size_t head_of_chunk = 8;
    std::string chunks;
    if (!encoded.substr(head).starts_with("VP8X")) {
        std::string extended(4, '\0');
        append_number(extended, static_cast<std::uint32_t>(image.width - 1), 3);
        append_number(extended, static_cast<std::uint32_t>(image.height - 1), 3);
        append_chunk(chunks, "VP8X", extended);
    }
    chunks += encoded.substr(head);
    chunks[head_of_chunk] = static_cast<char>(chunks[head_of_chunk] | has_exif);
    append_chunk(chunks, "EXIF", make_exif(options));
    std::string file;
    append_chunk(file, "RIFF", "WEBP" + chunks);
    return file;
}

}  // namespace

void write_webp(const std::filesystem::path& file, const TexelImage& image,
                const PngOptions& options)
{
    if (image.type != TexelType::unorm8 || (image.channels != 3 && image.channels != 4)) {
        throw Error(ErrorCode::usage,
                    fmt::format("{}: a WebP file has 3 or 4 channels of 8 bits", file.string()));
    }
    const auto channels = static_cast<std::size_t>(image.channels);
    const bool whole = image.bytes.size() % channels == 0;
    check_pixels(file, image.width, image.height, whole ? image.bytes.size() / channels : 0);
    if (image.width > WEBP_MAX_DIMENSION || image.height > WEBP_MAX_DIMENSION) {
        throw Error(ErrorCode::usage, fmt::format("{}: a WebP file has at most {} pixels a side",
                                                  file.string(), WEBP_MAX_DIMENSION));
    }
    WebpEncoder encoder;
    if (!encoder.encode(image)) {
        if (encoder.picture.error_code == VP8_ENC_ERROR_OUT_OF_MEMORY ||
            encoder.picture.error_code == VP8_ENC_ERROR_BITSTREAM_OUT_OF_MEMORY) {
            throw std::bad_alloc();
        }
        throw Error(ErrorCode::output,
                    fmt::format("{}: cannot write: WebP: error {}", file.string(),
                                static_cast<int>(encoder.picture.error_code)));
    }
    OutputFile output(file);
    output.write(with_exif({reinterpret_cast<const char*>(encoder.bytes.mem), encoder.bytes.size},
                           image, options));
    output.commit();
}

}  // namespace bdpt::io
