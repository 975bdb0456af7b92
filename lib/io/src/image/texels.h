#pragma once

#include "file/bytes.h"

#include <bdpt/image.h>
#include <bdpt/io/read_limits.h>

namespace bdpt::io {

/// Decodes a PNG, JPEG or WebP picture, told apart by its first bytes. 16-bit values are rounded to
/// 8 bits, grey becomes RGB, and without an alpha channel alpha is 255. Colours are not converted
/// and alpha is not multiplied in.
///
/// Throws `Error` (invalid_input) when the picture is too large, std::runtime_error when it cannot
/// be decoded, so that the caller may go on without it.
[[nodiscard]] TexelImage decode_texels(ByteView bytes, const ReadLimits& limits);

}  // namespace bdpt::io
