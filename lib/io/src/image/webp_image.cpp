#include "image/encoded_image.h"

#include <webp/decode.h>
#include <webp/demux.h>

#include <cstddef>
#include <stdexcept>
#include <string>

namespace bdpt::io {

namespace {

/// Describes an error. Truncation has been excluded before.
const char* describe(VP8StatusCode status)
{
    switch (status) {
        case VP8_STATUS_OUT_OF_MEMORY:
            return "out of memory";
        case VP8_STATUS_UNSUPPORTED_FEATURE:
            return "of an unknown kind";
        default:
            return "broken pixels";
    }
}

/// The chunks of a file and the first of its frames; a still image is a frame, too.
struct WebpFile final : ImageFile {
    WebPDemuxer* chunks = nullptr;
    WebPIterator frame{};

    explicit WebpFile(ByteView bytes)
    {
        const WebPData data{.bytes = bytes.data(), .size = bytes.size()};
        chunks = WebPDemux(&data);
        if (chunks != nullptr && WebPDemuxGetFrame(chunks, 1, &frame) != 0) {
            layout_.width = static_cast<int>(WebPDemuxGetI(chunks, WEBP_FF_CANVAS_WIDTH));
            layout_.height = static_cast<int>(WebPDemuxGetI(chunks, WEBP_FF_CANVAS_HEIGHT));
            const std::uint32_t flags = WebPDemuxGetI(chunks, WEBP_FF_FORMAT_FLAGS);
            layout_.channels = (flags & ALPHA_FLAG) != 0 ? 4 : 3;
        }
    }
    ~WebpFile() override
    {
        WebPDemuxReleaseIterator(&frame);
        WebPDemuxDelete(chunks);
    }

    void read(std::uint8_t* values) override
    {
        const auto channels = static_cast<std::size_t>(layout_.channels);
        const std::size_t stride = static_cast<std::size_t>(layout_.width) * channels;
        const std::size_t first = static_cast<std::size_t>(frame.y_offset) * stride +
                                  static_cast<std::size_t>(frame.x_offset) * channels;
        WebPDecoderConfig config;
        if (WebPInitDecoderConfig(&config) == 0) {
            throw std::runtime_error("WebP: another version of libwebp than its headers");
        }
        config.output.colorspace = layout_.channels == 4 ? MODE_RGBA : MODE_RGB;
        config.output.is_external_memory = 1;
        config.output.u.RGBA = {.rgba = values + first,
                                .stride = static_cast<int>(stride),
                                .size = stride * static_cast<std::size_t>(layout_.height) - first};
        const VP8StatusCode status = WebPDecode(frame.fragment.bytes, frame.fragment.size, &config);
        if (status != VP8_STATUS_OK) {
            throw std::runtime_error(std::string("WebP: ") + describe(status));
        }
    }
};

}  // namespace

std::unique_ptr<ImageFile> open_webp(ByteView bytes)
{
    auto file = std::make_unique<WebpFile>(bytes);
    if (file->layout().width == 0) {
        throw std::runtime_error("WebP: the header is broken, or the file ends too early");
    }
    return file;
}

}  // namespace bdpt::io
