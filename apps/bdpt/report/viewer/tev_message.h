#pragma once

#include <bdpt/image.h>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace bdpt::app {

// Messages of the tev image viewer's protocol over TCP [github.com/Tom94/tev, "inter-process
// communication" in its README]: total length in four bytes, a byte with the type of the message,
// and its fields, integers in little-endian order and strings with a zero at their end.

/// Returns the message that creates an empty image with the channels R, G and B, replacing one of
/// that name.
[[nodiscard]] std::string tev_create_image(std::string_view name, int width, int height);

/// Returns the message that fills rows `first_row` to `end_row` of `image` into the viewer's image;
/// (x, y) is the position of the image's first pixel in it. At least one row.
[[nodiscard]] std::string tev_update_image(std::string_view name, const Image& image, int x, int y,
                                           int first_row, int end_row);

}  // namespace bdpt::app
