#pragma once

/// @file
/// Gives numbers the colours of a heat map.
///
/// @code{.cpp}
/// bdpt::eval::Color8 heat_color(double value)  // in [0, 1]
/// {
///     static const std::vector<bdpt::eval::Color8> colors = bdpt::eval::heat_colors();
///     return colors.at(static_cast<std::size_t>(value * 255.0));
/// }
/// @endcode

#include <bdpt/export.h>

#include <array>
#include <cstdint>
#include <vector>

namespace bdpt::eval {

/// sRGB-encoded red, green, blue.
using Color8 = std::array<std::uint8_t, 3>;

/// Returns 256 colours from black through violet, red and orange to pale yellow. Neighbours are
/// equally far apart in CIE L*a*b*, and lightness increases monotonically, so the order is visible
/// without colour vision.
[[nodiscard]] BDPT_EXPORT std::vector<Color8> heat_colors();

}  // namespace bdpt::eval
