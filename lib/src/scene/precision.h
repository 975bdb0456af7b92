#pragma once

#include <bdpt/scene_desc.h>

#include <string>
#include <vector>

namespace bdpt {

/// Where single precision is too coarse for a valid scene, one line each: meshes that are small for
/// their distance from the origin, and lamps that are too near to a vast plane.
[[nodiscard]] std::vector<std::string> precision_warnings(const SceneDesc& desc);

}  // namespace bdpt
