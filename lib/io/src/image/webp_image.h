#pragma once

#include "file/bytes.h"

#include <cstdint>
#include <memory>

namespace bdpt::io {

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

}  // namespace bdpt::io
