#pragma once

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
