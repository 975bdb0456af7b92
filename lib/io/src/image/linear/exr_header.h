#pragma once

#include "file/bytes.h"

#include <bdpt/io/read_limits.h>

namespace bdpt::io {

/// Checks header fields by which OpenEXR allocates without checking: the size of an attribute as
/// stated, the table of lines by the data window, and a tile by its description [OpenEXR file
/// layout]. Throws `Error` (invalid_input) if an attribute is longer than the rest of the file, or
/// a window or a tile is larger than an image may be. Other faults are left to OpenEXR.
void check_exr_header(ByteView file, const ReadLimits& limits);

}  // namespace bdpt::io
