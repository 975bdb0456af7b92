#pragma once

#include "file/bytes.h"

#include <cstdint>
#include <memory>
#include <string>

namespace bdpt::io {

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

}  // namespace bdpt::io
