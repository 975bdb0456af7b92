#pragma once

#include "file/bytes.h"

#include <cstddef>
#include <cstdint>
#include <memory>

namespace bdpt::io {

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

}  // namespace bdpt::io
