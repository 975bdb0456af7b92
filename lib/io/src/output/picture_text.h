#pragma once

#include <bdpt/io/write_image.h>

#include <string>
#include <utility>
#include <vector>

namespace bdpt::io {

/// Returns the text entries of image files for screens: names and values.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> picture_text(
    const PngOptions& options);

}  // namespace bdpt::io
