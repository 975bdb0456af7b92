#pragma once

#include <bdpt/inspect.h>

#include <string>

#include "stage/prepared_scene.h"

namespace bdpt::app {

/// Returns the output of `bdpt inspect --json` for the sample, as one line, with the positions of
/// its vertices in the image: "raster", [x, y] or null. Throws as inspect_sample() does.
[[nodiscard]] std::string inspected_text(const PreparedScene& stage, RenderOptions options,
                                         const PixelSample& pixel);

}  // namespace bdpt::app
