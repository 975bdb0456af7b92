#pragma once

/// @file
/// Shows the errors of an image as colours.
///
/// @code{.cpp}
/// void write_errors(const bdpt::Image& image, const bdpt::Image& reference)
/// {
///     const bdpt::eval::ErrorMap map = bdpt::eval::flip(image, reference);
///     const bdpt::eval::FalseColorOptions options = {.scale = 0.5, .title = "flip"};
///     bdpt::io::write_png("errors.png", bdpt::eval::false_color(map, options), {});
/// }
/// @endcode

#include <bdpt/eval/metrics/error_map.h>
#include <bdpt/export.h>
#include <bdpt/io/tone_map.h>

#include <string>

namespace bdpt::eval {

/// Options of false-colour images.
struct FalseColorOptions {
    double scale = 1.0;  ///< error of the last colour, > 0; greater errors have that colour, too
    std::string title;   ///< text under the colour bar: lower-case letters, digits and "_+-. "
};

/// Draws the errors in `heat_colors` from 0 to `scale`, above a colour bar with its values. The
/// map's pixels are the top left corner, one to one. A map narrower than the bar is padded with
/// grey.
[[nodiscard]] BDPT_EXPORT io::DisplayImage false_color(const ErrorMap& map,
                                                       const FalseColorOptions& options);

}  // namespace bdpt::eval
