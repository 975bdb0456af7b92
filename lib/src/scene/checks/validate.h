#pragma once

#include <bdpt/scene.h>

namespace bdpt {

/// Throws `Error` (invalid_input) for the first value in `desc` that no scene can have: an index
/// out of range, a number that is not finite or outside of its range, a transform without an
/// inverse. The message names the item and the value. `valid` is a valid description: what both
/// share is not looked at again.
void validate(const SharedSceneDesc& desc, const SharedSceneDesc& valid = {});

/// Counts of a valid description, lights left out.
[[nodiscard]] SceneCounts count(const SharedSceneDesc& desc);

}  // namespace bdpt
