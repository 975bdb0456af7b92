#include <bdpt/io/picture.h>

#include <bdpt/error.h>
#include <bdpt/io/output_file.h>
#include <fmt/core.h>
#include <webp/encode.h>

#include <cstddef>
#include <new>

#include "output/check_pixels.h"

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

}  // namespace

void write_webp(const std::filesystem::path& file, const TexelImage& image)
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
    output.write({reinterpret_cast<const char*>(encoder.bytes.mem), encoder.bytes.size});
    output.commit();
}

}  // namespace bdpt::io
