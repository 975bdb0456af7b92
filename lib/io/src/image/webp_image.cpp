#include "image/encoded_image.h"

#include <webp/decode.h>
#include <webp/demux.h>

#include <cstddef>
#include <stdexcept>
#include <string>

namespace bdpt::io {

/// The chunks of a file and the first of its frames; a still image is a frame, too.
struct WebpImage::State {
    WebPDemuxer* chunks = nullptr;
    WebPIterator frame{};

    [[nodiscard]] std::uint32_t get(WebPFormatFeature feature) const
    {
        return WebPDemuxGetI(chunks, feature);
    }
};

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

}  // namespace

void WebpImage::Close::operator()(State* state) const
{
    const std::unique_ptr<State> owned(state);
    WebPDemuxReleaseIterator(&owned->frame);
    WebPDemuxDelete(owned->chunks);
}

WebpImage::WebpImage(ByteView bytes) : state_(new State)
{
    const WebPData data{.bytes = bytes.data(), .size = bytes.size()};
    state_->chunks = WebPDemux(&data);
    if (state_->chunks == nullptr || WebPDemuxGetFrame(state_->chunks, 1, &state_->frame) == 0) {
        throw std::runtime_error("WebP: the header is broken, or the file ends too early");
    }
    width_ = static_cast<int>(state_->get(WEBP_FF_CANVAS_WIDTH));
    height_ = static_cast<int>(state_->get(WEBP_FF_CANVAS_HEIGHT));
    channels_ = (state_->get(WEBP_FF_FORMAT_FLAGS) & ALPHA_FLAG) != 0 ? 4 : 3;
}

void WebpImage::read(std::uint8_t* values)
{
    const WebPIterator& frame = state_->frame;
    const auto channels = static_cast<std::size_t>(channels_);
    const std::size_t stride = static_cast<std::size_t>(width_) * channels;
    const std::size_t first = static_cast<std::size_t>(frame.y_offset) * stride +
                              static_cast<std::size_t>(frame.x_offset) * channels;
    WebPDecoderConfig config;
    if (WebPInitDecoderConfig(&config) == 0) {
        throw std::runtime_error("WebP: another version of libwebp than its headers");
    }
    config.output.colorspace = channels_ == 4 ? MODE_RGBA : MODE_RGB;
    config.output.is_external_memory = 1;
    config.output.u.RGBA = {.rgba = values + first,
                            .stride = static_cast<int>(stride),
                            .size = stride * static_cast<std::size_t>(height_) - first};
    const VP8StatusCode status = WebPDecode(frame.fragment.bytes, frame.fragment.size, &config);
    if (status != VP8_STATUS_OK) {
        throw std::runtime_error(std::string("WebP: ") + describe(status));
    }
}

}  // namespace bdpt::io
