#pragma once

#include <bdpt/eval/drawing.h>

#include <array>
#include <string_view>

namespace bdpt::eval {

constexpr int glyph_width = 5;  // [dots]

/// Rows of a character's image, five letters each: '#' is ink. Characters without an image are
/// blank.
using Glyph = std::array<std::string_view, glyph_height>;

[[nodiscard]] const Glyph& glyph(char c);

}  // namespace bdpt::eval
