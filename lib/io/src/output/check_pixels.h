#pragma once

#include <bdpt/error.h>
#include <fmt/core.h>

#include <cstddef>
#include <filesystem>

namespace bdpt::io {

/// Throws `Error` (usage) if an image to be written has no pixels, or does not have `width` *
/// `height` of them.
inline void check_pixels(const std::filesystem::path& file, int width, int height,
                         std::size_t pixels)
{
    const bool sound = width > 0 && height > 0 &&
                       pixels == static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    if (!sound) {
        throw Error(ErrorCode::usage, fmt::format("{}: an image of {} x {} with {} pixels",
                                                  file.string(), width, height, pixels));
    }
}

}  // namespace bdpt::io
