#pragma once

#include <bdpt/io/read_limits.h>

#include <cstdint>

namespace bdpt::io {

/// Refuses images beyond the limits, by what their headers say. `bytes_per_pixel` is that of the
/// decoded image, `encoded` the size of the file [bytes]. Throws `Error` (invalid_input).
void check_image_size(int width, int height, std::uint64_t bytes_per_pixel, std::uint64_t encoded,
                      const ReadLimits& limits);

}  // namespace bdpt::io
