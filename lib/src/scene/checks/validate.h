#pragma once

#include <bdpt/scene.h>

namespace bdpt {

/// Throws `Error` (invalid_input) for the first invalid value in `desc`: an index out of range, a
/// number that is not finite or outside of its range, a transform without an inverse. The message
/// names the item and the value. `valid` is a valid description: lists that both share are not
/// checked again.
void validate(const SharedSceneDesc& desc, const SharedSceneDesc& valid = {});

/// Counts a valid description, excluding lights.
[[nodiscard]] SceneCounts count(const SharedSceneDesc& desc);

}  // namespace bdpt
