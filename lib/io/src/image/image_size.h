#pragma once

#include <bdpt/io/memory_budget.h>
#include <bdpt/io/read_limits.h>

#include <cstdint>

namespace bdpt::io {

/// Refuses images beyond the limits, by what their headers say. `bytes_per_pixel` is that of the
/// decoded image. How small the file is does not count: a dark image is packed a thousandfold in
/// good faith. What `memory` does not have is refused as it refuses it. Throws `Error`
/// (invalid_input).
void check_image_size(int width, int height, std::uint64_t bytes_per_pixel,
                      const ReadLimits& limits, const MemoryBudget* memory = nullptr);

}  // namespace bdpt::io
