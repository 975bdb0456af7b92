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

// A font of 5 x 7 dots with what labels are made of: digits, small letters, and signs of numbers.
// It depends on no file, so that labels look the same everywhere.

constexpr int glyph_height = 7;   ///< dots from a line's top to its bottom
constexpr int glyph_advance = 6;  ///< dots from one letter to the next

/// Is there a glyph for `letter`? All others are drawn as spaces.
[[nodiscard]] BDPT_EXPORT bool has_glyph(char letter);

/// Where and how large a text is drawn.
struct TextPlace {
    int x = 0;  ///< top left corner [pixels]
    int y = 0;
    int dot = 1;  ///< side of a dot [pixels]
};

/// `image` with `text` in light grey; what is outside of it is cut off.
[[nodiscard]] BDPT_EXPORT io::DisplayImage with_text(io::DisplayImage image, std::string_view text,
                                                     const TextPlace& place);

}  // namespace bdpt::eval
