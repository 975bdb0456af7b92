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

/// How errors become colours.
struct FalseColorOptions {
    double scale = 1.0;  ///< > 0: the error that has the last colour; greater ones have it too
    std::string title;   ///< under the colour bar: lower-case letters, digits and "_+-. "
};

/// The errors as `heat_colors` from 0 to `scale`, above a bar that shows which colour is how much:
/// the map's pixels are the top left corner, one to one. Maps that are narrower than the bar needs
/// have grey beside them.
[[nodiscard]] BDPT_EXPORT io::DisplayImage false_color(const ErrorMap& map,
                                                       const FalseColorOptions& options);

}  // namespace bdpt::eval
