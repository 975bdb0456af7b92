#pragma once

#include <bdpt/error.h>
#include <bdpt/io/write_image.h>
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "file/messages.h"

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

/// Calls `write()`, which writes `file`. Exceptions of libraries become an `Error` (output) that
/// names the file; an `Error` and std::bad_alloc are passed on.
template <typename Write>
void with_write_errors(const std::filesystem::path& file, const Write& write)
{
    with_library_errors(ErrorCode::output, file.string() + ": cannot write: ", write);
}

/// Returns the text entries of image files for screens: names and values.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> picture_text(
    const PngOptions& options);

/// Encodes a linear value [IEC 61966-2-1], which is clamped, to [0, 1]; NaN gives 0.
inline float srgb_code(float linear)
{
    const float value = linear > 0.0f ? std::min(linear, 1.0f) : 0.0f;
    return value <= 0.0031308f ? 12.92f * value : 1.055f * std::pow(value, 1.0f / 2.4f) - 0.055f;
}

/// Decodes an sRGB value: the inverse of `srgb_code`.
inline float srgb_linear(float code)
{
    return code <= 0.04045f ? code / 12.92f : std::pow((code + 0.055f) / 1.055f, 2.4f);
}

}  // namespace bdpt::io
