#pragma once

#include "file/bytes.h"
#include "image/linear/oiio_interface.h"

#include <cstddef>
#include <memory>

namespace bdpt::io {

/// An image that OpenImageIO has opened in memory, which must stay there. It may be read on another
/// thread.
class OiioImage {
public:
    [[nodiscard]] const BdptImageHeader& header() const { return header_; }
    /// Returns the number of values of all pixels.
    [[nodiscard]] std::size_t value_count() const;

    /// Reads all pixels as stored, top row first, into room for `value_count()` values; integers
    /// are scaled to [0, 1]. Throws std::runtime_error if they cannot be decoded.
    void read(float* values) const;

private:
    friend class OiioLibrary;
    struct Functions {
        decltype(&bdpt_oiio_open) open = nullptr;
        decltype(&bdpt_oiio_read_floats) read_floats = nullptr;
        decltype(&bdpt_oiio_close) close = nullptr;
    };

    OiioImage(const Functions& functions, const char* format, ByteView bytes);

    Functions functions_;
    BdptImageHeader header_{};
    std::unique_ptr<BdptImage, decltype(&bdpt_oiio_close)> image_;
};

/// OpenImageIO, loaded into the process with the first object of this class; it stays loaded.
/// Objects are cheap.
class OiioLibrary {
public:
    /// Throws `Error`: unsupported if the module cannot be found or loaded, internal if it is of
    /// another version.
    OiioLibrary();

    /// Opens an image in memory; `format` is one of OpenImageIO's names. Throws std::runtime_error
    /// if it cannot be opened.
    [[nodiscard]] OiioImage open(const char* format, ByteView bytes) const;

private:
    OiioImage::Functions functions_;
};

}  // namespace bdpt::io
