#pragma once

#include "file/bytes.h"

#include <cstdint>
#include <memory>
#include <string>

namespace bdpt::io {

/// A JPEG file in memory whose header has been read: baseline or progressive, 8 bits a channel,
/// grey, RGB, YCbCr, CMYK or YCCK. By libjpeg.
class JpegImage {
public:
    /// `bytes` must stay as long as the image. Throws std::runtime_error when the header is broken,
    /// or says that the image is of another kind.
    explicit JpegImage(ByteView bytes);

    [[nodiscard]] int width() const { return width_; }
    [[nodiscard]] int height() const { return height_; }
    /// 1: grey, 3: RGB, which all other kinds become.
    [[nodiscard]] int channels() const { return channels_; }
    [[nodiscard]] static constexpr int value_bytes() { return 1; }

    /// Decodes all pixels, top row first, into room for width * height * channels values; once.
    /// Throws std::runtime_error when nothing can be decoded, or not with reasonable work.
    void read(std::uint8_t* values);

    /// What is wrong with data that can be decoded all the same, as far as it has been read: the
    /// first that libjpeg names. Empty: nothing. Where data is missing, pixels are guessed or grey.
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
