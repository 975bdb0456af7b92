#pragma once

#include <bdpt/io/read_limits.h>

#include <cstdint>

namespace bdpt::io {

/// Refuses images beyond the limits, by their headers. `bytes_per_pixel` is that of the decoded
/// image. There is no limit on the compression ratio: a dark image may legitimately shrink a
/// thousandfold. Throws as `memory` does if that does not have the bytes. Throws `Error`
/// (invalid_input).
void check_image_size(int width, int height, std::uint64_t bytes_per_pixel,
                      const ReadLimits& limits, const MemoryBudget* memory = nullptr);

}  // namespace bdpt::io
