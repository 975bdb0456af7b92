#pragma once

/// @file
/// Writes labels into images.
///
/// @code{.cpp}
/// bdpt::io::DisplayImage labelled(bdpt::io::DisplayImage image)
/// {
///     return bdpt::eval::with_text(std::move(image), "64 samples", {.x = 8, .y = 8, .dot = 2});
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/io/tone_map.h>

#include <string_view>

namespace bdpt::eval {

// A font of 5 x 7 dots with the characters of labels: digits, small letters, and signs of numbers.
// It is compiled in, so labels look the same on every machine.

constexpr int glyph_height = 7;   ///< height of a line [dots]
constexpr int glyph_advance = 6;  ///< distance from one letter to the next [dots]

/// Tests whether there is a glyph for `letter`. Others are drawn as spaces.
[[nodiscard]] BDPT_EXPORT bool has_glyph(char letter);

/// Position and size of a text.
struct TextPlace {
    int x = 0;  ///< top left corner [pixels]
    int y = 0;
    int dot = 1;  ///< side of a dot [pixels]
};

/// Draws `text` on `image` in light grey, clipped to the image.
[[nodiscard]] BDPT_EXPORT io::DisplayImage with_text(io::DisplayImage image, std::string_view text,
                                                     const TextPlace& place);

}  // namespace bdpt::eval
