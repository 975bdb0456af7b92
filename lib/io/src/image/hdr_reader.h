#pragma once

#include "file/bytes.h"

#include <bdpt/image.h>
#include <bdpt/io/read_limits.h>

namespace bdpt::io {

/// Whether a file is Radiance HDR, by its first bytes.
[[nodiscard]] bool is_hdr(ByteView file);

/// Decodes a Radiance HDR image as linear RGB. Throws `Error`: invalid_input (broken, or over a
/// limit), internal when OpenImageIO cannot be loaded.
[[nodiscard]] Image read_hdr(ByteView file, const ReadLimits& limits);

}  // namespace bdpt::io
