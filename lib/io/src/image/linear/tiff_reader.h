#pragma once

#include "file/bytes.h"

#include <bdpt/image.h>
#include <bdpt/io/read_limits.h>

namespace bdpt::io {

/// Tests whether a file is TIFF, by its first bytes.
[[nodiscard]] bool is_tiff(ByteView file);

/// Decodes the first image of a TIFF file to linear RGB, by OpenImageIO: floats of any size, grey
/// or RGB. Alpha and other channels are ignored. Throws `Error`: invalid_input (broken, or over a
/// limit), unsupported (integers, another orientation; no OpenImageIO).
[[nodiscard]] Image read_tiff(ByteView file, const ReadLimits& limits,
                              const MemoryBudget* memory = nullptr);

}  // namespace bdpt::io
