#pragma once

#include "scene/scene_geometry.h"

#include <string>
#include <vector>

namespace bdpt {

/// Where single precision is too coarse for a valid scene, one line each: meshes that are small for
/// their distance from the origin, and lamps that are too near to a vast plane. `geometry` fits
/// `desc`.
[[nodiscard]] std::vector<std::string> precision_warnings(const SharedSceneDesc& desc,
                                                          const SceneGeometry& geometry);

}  // namespace bdpt
