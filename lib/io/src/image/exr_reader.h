#pragma once

#include "file/bytes.h"
#include "file/warnings.h"

#include <bdpt/image.h>
#include <bdpt/io/read_limits.h>

namespace bdpt::io {

/// Whether a file is OpenEXR, by its first bytes.
[[nodiscard]] bool is_exr(ByteView file);

/// Decodes the colours of the first part of an OpenEXR file as linear RGB: channels R, G, B, or Y
/// with or without RY, BY, of the unnamed layer or else of the first that has them. The picture is
/// the display window; black where there is no data.
///
/// Throws `Error`: invalid_input (broken, or over a limit), unsupported (deep data, other
/// channels).
[[nodiscard]] Image read_exr(ByteView file, const ReadLimits& limits, Warnings& warnings);

}  // namespace bdpt::io
