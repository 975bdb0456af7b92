#pragma once

#include <bdpt/shared_scene_desc.h>

#include <string>

namespace bdpt {

/// Throws `Error` (invalid_input) for the first invalid value of the lights and their profiles.
/// `reach` is the maximum distance of lights from the origin [m].
void validate_lights(const SharedSceneDesc& desc, float reach);

/// Returns the end of a message that states the distance limit and its reason.
[[nodiscard]] std::string limit_text(float reach);

}  // namespace bdpt
