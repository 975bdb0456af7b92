#pragma once

#include <bdpt/image.h>

#include <span>

namespace bdpt::app {

/// Returns the values of partially visible content: `layer` divided by `shares`, one in [0, 1] per
/// pixel, by which its values are premultiplied. Pixels that show nothing get the mean of the
/// smallest block of pixels around that shows something, by a pyramid as in [Gortler et al. 1996,
/// "The Lumigraph", 3.4], so that a filter finds no edge there.
[[nodiscard]] Layer visible_values(const Layer& layer, std::span<const float> shares);

}  // namespace bdpt::app
