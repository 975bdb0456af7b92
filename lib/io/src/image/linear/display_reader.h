#pragma once

#include "file/bytes.h"
#include "file/warnings.h"

#include <bdpt/image.h>
#include <bdpt/io/read_limits.h>

namespace bdpt::io {

/// Tests whether a file is PNG, JPEG or WebP, by its first bytes.
[[nodiscard]] bool is_display_image(ByteView file);

/// Decodes a PNG, JPEG or WebP image, taken as sRGB-encoded [IEC 61966-2-1], to linear RGB in [0,
/// 1]. Alpha and colour profiles are ignored. Throws `Error` (invalid_input): broken, or over a
/// limit.
[[nodiscard]] Image read_display_image(ByteView file, const ReadLimits& limits, Warnings& warnings,
                                       const MemoryBudget* memory = nullptr);

}  // namespace bdpt::io
