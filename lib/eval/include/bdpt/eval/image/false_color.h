#pragma once

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
