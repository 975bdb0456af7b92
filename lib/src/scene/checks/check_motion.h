#pragma once

#include <bdpt/shared_scene_desc.h>

namespace bdpt {

/// Checks everything that moves in a scene that is valid when the shutter opens; `reach` as in
/// geometry/coordinate_limit.h, and lights only if the positions of meshes are known to be valid.
/// Throws `Error` (invalid_input).
void check_motion(const SharedSceneDesc& desc, float reach, bool places_are_valid);

}  // namespace bdpt
