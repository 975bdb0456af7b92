#pragma once

#include "file/bytes.h"
#include "image/oiio_interface.h"

#include <bdpt/io/read_limits.h>

#include <cstddef>
#include <cstdint>
#include <memory>

namespace bdpt::io {

/// An image that OpenImageIO has opened in memory, which must stay there. It may be read on
/// another thread.
class OiioImage {
public:
    [[nodiscard]] const BdptImageHeader& header() const { return header_; }
    /// Values of all pixels.
    [[nodiscard]] std::size_t value_count() const;

    /// Reads all pixels as they are stored, top row first, into room for `value_count()` values.
    /// Throws std::runtime_error when they cannot be decoded.
    void read(std::uint8_t* values) const;
    void read(std::uint16_t* values) const;
    void read(float* values) const;

private:
    friend class OiioLibrary;
    struct Functions {
        decltype(&bdpt_oiio_open) open = nullptr;
        decltype(&bdpt_oiio_read_bytes) read_bytes = nullptr;
        decltype(&bdpt_oiio_read_words) read_words = nullptr;
        decltype(&bdpt_oiio_read_floats) read_floats = nullptr;
        decltype(&bdpt_oiio_close) close = nullptr;
    };

    OiioImage(const Functions& functions, const char* format, ByteView bytes);

    Functions functions_;
    BdptImageHeader header_{};
    std::unique_ptr<BdptImage, decltype(&bdpt_oiio_close)> image_;
};

/// OpenImageIO, loaded into the process with the first object of this class; it stays there. To
/// have one is cheap.
class OiioLibrary {
public:
    /// Throws `Error` (internal) when the module cannot be found or loaded.
    OiioLibrary();

    /// Opens an image in memory; `format` is one of OpenImageIO's names. Throws
    /// std::runtime_error when it cannot be opened.
    [[nodiscard]] OiioImage open(const char* format, ByteView bytes) const;

private:
    OiioImage::Functions functions_;
};

/// Refuses images beyond the limits. `encoded` is the size of the file, `decoded` that of the
/// pixels [bytes]. Throws `Error` (invalid_input).
void check_image_size(int width, int height, std::uint64_t bytes_per_pixel, std::uint64_t encoded,
                      const ReadLimits& limits);

}  // namespace bdpt::io
