#pragma once

#include "scene/scene_geometry.h"

#include <string>
#include <vector>

namespace bdpt {

/// Returns warnings about insufficient single precision in a valid scene, one line each: meshes
/// that are small relative to their distance from the origin, and lights that are too near to a
/// vast plane. `geometry` fits `desc`.
[[nodiscard]] std::vector<std::string> precision_warnings(const SharedSceneDesc& desc,
                                                          const SceneGeometry& geometry);

}  // namespace bdpt
