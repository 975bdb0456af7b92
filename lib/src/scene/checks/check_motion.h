#pragma once

#include <bdpt/scene_desc.h>

namespace bdpt {

/// Checks all that moves in a scene that is valid when the shutter opens; `reach` as in
/// geometry/coordinate_limit.h. Throws `Error` (invalid_input).
void check_motion(const SceneDesc& desc, float reach);

}  // namespace bdpt
