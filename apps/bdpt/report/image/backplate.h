#pragma once

#include <bdpt/image.h>
#include <bdpt/io/exr.h>

#include <filesystem>
#include <optional>

#include "options/groups/display_arguments.h"

namespace bdpt::app {

/// Fits `image` to a full frame: scales it uniformly until it covers the frame, crops two sides if
/// its proportions differ, and returns the part that lies behind the frame's region from x and y.
/// Filtered in linear light; an image of the frame's size is unchanged. Values are limited to [0,
/// 1], what a screen shows.
[[nodiscard]] Image behind_frame(const Image& image, const io::ExrPlacement& frame, int width,
                                 int height);

/// Returns the photograph that is shown behind `image` where it covers nothing, if any; `frame`:
/// position of `image` in the frame, none: it is the whole. Throws `Error` if the file cannot be
/// read.
[[nodiscard]] std::optional<Image> backplate(const DisplayArguments& display, const Image& image,
                                             const std::optional<io::ExrPlacement>& frame);

/// Throws `Error`, before anything is rendered, if the file of a photograph cannot be read.
void check_backplate(const DisplayArguments& display);

/// The photograph that the metadata of `image` name: where the name leads, else beside the image.
[[nodiscard]] std::filesystem::path find_photo(const std::filesystem::path& named,
                                               const std::filesystem::path& image);

}  // namespace bdpt::app
