#pragma once

#include "file/bytes.h"
#include "file/warnings.h"
#include "image/linear/row_sink.h"

#include <bdpt/image.h>
#include <bdpt/io/read_limits.h>

namespace bdpt::io {

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

}  // namespace bdpt::io
