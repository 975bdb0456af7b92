#pragma once

#include "file/read_file.h"

#include <cstdint>
#include <string>
#include <vector>

namespace bdpt::io {

/// Values of all channels, top row first.
struct Picture {
    int width = 0;
    int height = 0;
    int channels = 0;
    std::vector<std::uint8_t> values{};
};

/// Slopes with noise, different in each channel; the same at each call.
[[nodiscard]] Picture make_picture(int width, int height, int channels);

enum class JpegKind {
    baseline,     ///< YCbCr
    subsampled,   ///< colours at half the size
    progressive,  ///< in several scans
    restarts,     ///< with marks to start again from
    grey,
    rgb,
    cmyk,  ///< inks, as Adobe's programs store them
    ycck,
    two_channels,  ///< nobody knows of what
};
/// How many channels a picture has that is encoded so.
[[nodiscard]] int channels_of(JpegKind kind);
/// A JPEG file, by libjpeg.
[[nodiscard]] std::string encode_jpeg(const Picture& picture, JpegKind kind);

/// A progressive JPEG file whose last scan is there `times` times more.
[[nodiscard]] std::string repeat_scan(const std::string& file, int times);

/// A WebP file of three or four channels, by libwebp. If it is lossless, colours stay as they are
/// where alpha is 0, too.
[[nodiscard]] std::string encode_webp(const Picture& picture, bool lossless);

/// An animation of two frames on a canvas of `width` x `height`: `first` at (x, y), which are even,
/// then `second` at (0, 0). Both are WebP files of one chunk.
struct Frame {
    std::string file{};
    int width = 0;
    int height = 0;
};
[[nodiscard]] std::string animate(int width, int height, const Frame& first, int x, int y,
                                  const Frame& second);

[[nodiscard]] ByteView view(const std::string& file);

}  // namespace bdpt::io
