#pragma once

#include "file/bytes.h"

#include <bdpt/io/read_limits.h>

namespace bdpt::io {

/// Checks what OpenEXR believes before it looks: it makes room for an attribute of the header by
/// the size that the file states, for the table of lines by the data window, and for a tile by its
/// description [OpenEXR file layout]. Throws `Error` (invalid_input) when an attribute is longer
/// than the rest of the file, or a window or a tile is larger than an image may be. Other faults
/// are left to OpenEXR.
void check_exr_header(ByteView file, const ReadLimits& limits);

}  // namespace bdpt::io
