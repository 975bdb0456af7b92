#pragma once

#include "file/bytes.h"
#include "image/oiio_interface.h"

#include <bdpt/io/read_limits.h>

#include <string>
#include <vector>

namespace bdpt::io {

/// A decoded picture as it is stored, top row first.
template <typename T>
struct RawPicture {
    int width = 0;
    int height = 0;
    int channels = 0;
    int alpha_channel = -1;
    std::vector<T> values;
};

/// OpenImageIO, loaded into the process with the first object of this class; it stays there. To
/// have one is cheap.
class OiioLibrary {
public:
    /// Throws `Error` (internal) when the module cannot be found or loaded.
    OiioLibrary();

    /// Decodes a picture in memory; `format` is one of OpenImageIO's names. T is std::uint8_t or
    /// float. Throws `Error` (invalid_input) when it is too large, std::runtime_error when it
    /// cannot be decoded.
    template <typename T>
    [[nodiscard]] RawPicture<T> decode(const char* format, ByteView bytes,
                                       const ReadLimits& limits) const;

private:
    decltype(&bdpt_oiio_open) open_ = nullptr;
    decltype(&bdpt_oiio_read_bytes) read_bytes_ = nullptr;
    decltype(&bdpt_oiio_read_floats) read_floats_ = nullptr;
    decltype(&bdpt_oiio_close) close_ = nullptr;
};

/// Refuses pictures beyond the limits. `encoded` is the size of the file, `decoded` that of the
/// pixels [bytes]. Throws `Error` (invalid_input).
void check_picture_size(int width, int height, std::uint64_t bytes_per_pixel, std::uint64_t encoded,
                        const ReadLimits& limits);

}  // namespace bdpt::io
