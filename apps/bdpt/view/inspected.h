#pragma once

#include <bdpt/inspect.h>

#include <string>

#include "stage/prepared_scene.h"

namespace bdpt::app {

/// What `bdpt inspect --json` prints of the sample, as one line, and where its vertices are in the
/// image: "raster", [x, y] or null. Throws as inspect_sample() does.
[[nodiscard]] std::string inspected_text(const PreparedScene& stage, RenderOptions options,
                                         const PixelSample& pixel);

}  // namespace bdpt::app
