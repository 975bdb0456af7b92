#pragma once

#include "file/bytes.h"
#include "file/warnings.h"
#include "image/linear/row_sink.h"

#include <bdpt/image.h>
#include <bdpt/io/read_limits.h>
#include <bdpt/pixel_rect.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace bdpt::io {

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
