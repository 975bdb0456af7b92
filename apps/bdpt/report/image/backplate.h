#pragma once

#include <bdpt/image.h>
#include <bdpt/io/exr.h>

#include <optional>

#include "options/groups/display_arguments.h"

namespace bdpt::app {

/// `image` as it fills a frame of that size: scaled evenly until it covers the frame, and cut on
/// two sides where it has other proportions; of this, what is behind the part of the frame that
/// begins at x and y. Filtered in linear light; an image of the frame's size stays as it is. Values
/// are limited to [0, 1], what a screen shows.
[[nodiscard]] Image behind_frame(const Image& image, const io::ExrPlacement& frame, int width,
                                 int height);

/// What is seen behind `image` where it covers nothing, if that is a photograph; `frame`: where it
/// lies, none: it is the whole. Throws `Error` where the file cannot be read.
[[nodiscard]] std::optional<Image> backplate(const DisplayArguments& display, const Image& image,
                                             const std::optional<io::ExrPlacement>& frame);

/// Throws `Error` where the file of a photograph cannot be read, before anything is rendered.
void check_backplate(const DisplayArguments& display);

}  // namespace bdpt::app
