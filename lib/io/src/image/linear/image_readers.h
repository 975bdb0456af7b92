#pragma once

#include <bdpt/image.h>
#include <bdpt/io/read_limits.h>
#include <bdpt/pixel_rect.h>
#include <bdpt/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "file/messages.h"
#include "file/read_file.h"
#include "image/encoded_image.h"
#include "image/linear/oiio_interface.h"

namespace bdpt::io {

/// Receives an image row by row.
struct RowSink {
    std::function<void(int width, int height)> begin;  ///< may throw, if the image is too large
    /// Takes the next row from the top and may change its values; returns false to stop.
    std::function<bool(std::span<Rgb> row)> add;
};

/// Decodes a PNG, JPEG or WebP image, taken as sRGB-encoded [IEC 61966-2-1], to linear RGB in [0,
/// 1]. Alpha and colour profiles are ignored. Throws `Error` (invalid_input): broken, or over a
/// limit.
[[nodiscard]] Image read_display_image(ByteView file, const ReadLimits& limits, Warnings& warnings,
                                       const MemoryBudget* memory = nullptr);

/// Mantissas of red, green and blue and their exponent e: values are mantissa * 2^(e - 136), and 0
/// where e is 0 [Ward, "Real Pixels", Graphics Gems II, 1991, sec. II.5].
using Rgbe = std::array<std::uint8_t, 4>;

/// The scanlines of a Radiance HDR image, one after the other. Each is flat, or run-length encoded
/// in the older or the newer way [Ward, "The RADIANCE Picture File Format"].
class HdrScanlines {
public:
    /// `encoded` is the data behind the header; it must outlive this object.
    explicit HdrScanlines(ByteView encoded) : rest_(encoded) {}

    /// Reads the next scanline. Throws `Error` (invalid_input) that names the scanline if it is
    /// broken or truncated.
    void read(std::span<Rgbe> line);

private:
    [[nodiscard]] std::uint8_t take();
    [[nodiscard]] Rgbe take_pixel();
    void read_by_pixels(std::span<Rgbe> line);
    void read_by_components(std::span<Rgbe> line);
    void read_component(std::span<Rgbe> line, std::size_t component);
    [[noreturn]] void fail(const char* what) const;

    ByteView rest_;
    std::size_t number_ = 0;  // number of the scanline, from 1
};

/// Tests whether a file is Radiance HDR, by its first bytes.
[[nodiscard]] bool is_hdr(ByteView file);

/// Decodes a Radiance HDR image to linear RGB, in any of its eight orientations. The exposure in
/// the header is divided out, with a warning. Throws `Error`: invalid_input (broken, or over a
/// limit), unsupported (pixels other than 32-bit_rle_rgbe).
[[nodiscard]] Image read_hdr(ByteView file, const ReadLimits& limits, Warnings& warnings,
                             const MemoryBudget* memory = nullptr);

/// Passes the rows of the image from the top, each valid during the call, without memory for all of
/// them, until `add` returns false. Returns whether all have been passed; false without any for
/// another orientation or an exposure. Throws like `read_hdr`.
[[nodiscard]] bool read_hdr_rows(ByteView file, const ReadLimits& limits, const RowSink& sink);

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

/// Tests whether a file is TIFF, by its first bytes.
[[nodiscard]] bool is_tiff(ByteView file);

/// Decodes the first image of a TIFF file to linear RGB, by OpenImageIO: floats of any size, grey
/// or RGB. Alpha and other channels are ignored. Throws `Error`: invalid_input (broken, or over a
/// limit), unsupported (integers, another orientation; no OpenImageIO).
[[nodiscard]] Image read_tiff(ByteView file, const ReadLimits& limits,
                              const MemoryBudget* memory = nullptr);

/// Checks header fields by which OpenEXR allocates without checking: the size of an attribute as
/// stated, the table of lines by the data window, and a tile by its description [OpenEXR file
/// layout]. Throws `Error` (invalid_input) if an attribute is longer than the rest of the file, or
/// a window or a tile is larger than an image may be. Other faults are left to OpenEXR.
void check_exr_header(ByteView file, const ReadLimits& limits);

/// Tests whether a file is OpenEXR, by its first bytes.
[[nodiscard]] bool is_exr(ByteView file);

/// The display window of an OpenEXR file, black where there is no data.
struct ExrImage {
    Image image;
    PixelRect filled;     ///< region with data
    bool halves = false;  ///< its values were half floats
    /// Names and values of texts and numbers in the header.
    std::vector<std::pair<std::string, std::string>> attributes{};
};

/// Decodes a layer of the first part of an OpenEXR file to linear RGB: by `find_layer`, or without
/// a layer name by `find_colors`.
///
/// Throws `Error`: not_found (no such layer), invalid_input (broken, or over a limit), unsupported
/// (deep data, other channels).
[[nodiscard]] ExrImage read_exr(ByteView file, const std::optional<std::string>& layer,
                                const ReadLimits& limits, Warnings& warnings,
                                const MemoryBudget* memory = nullptr);

/// Passes the rows of an image of half floats, whose data fill the display window, in blocks from
/// the top, without memory for all of them, until `add` returns false. Returns whether all have
/// been passed; false without any for another image. Throws like `read_exr`.
[[nodiscard]] bool read_half_exr_rows(ByteView file, const ReadLimits& limits, Warnings& warnings,
                                      const RowSink& sink);

}  // namespace bdpt::io
