#include "image/image_size.h"

#include "file/read_file.h"

#include <bdpt/error.h>

#include <fmt/format.h>

namespace bdpt::io {

void check_image_size(int width, int height, std::uint64_t bytes_per_pixel,
                      const ReadLimits& limits, const MemoryBudget* memory)
{
    if (width > limits.image_side || height > limits.image_side) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("image of {} x {} pixels, but the limit is {} a side", width,
                                height, limits.image_side));
    }
    const std::uint64_t decoded =
        static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height) * bytes_per_pixel;
    if (decoded > limits.image_bytes) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("image of {} x {} pixels needs {}, but the limit is {}", width,
                                height, human_bytes(static_cast<long double>(decoded)),
                                human_bytes(static_cast<long double>(limits.image_bytes))));
    }
    if (memory != nullptr) {
        memory->check(fmt::format("image of {} x {} pixels", width, height), decoded);
    }
}

}  // namespace bdpt::io
