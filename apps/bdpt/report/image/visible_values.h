#pragma once

#include <bdpt/image.h>

#include <span>

namespace bdpt::app {

/// The values of what pixels show in part: `layer` divided by `shares`, one in [0, 1] for each
/// pixel, which its values are multiplied by. Where pixels show nothing, they are the mean of the
/// smallest block of pixels around that shows something, by a pyramid as in [Gortler et al. 1996,
/// "The Lumigraph", 3.4]: so that a filter finds no edge there.
[[nodiscard]] Layer visible_values(const Layer& layer, std::span<const float> shares);

}  // namespace bdpt::app
