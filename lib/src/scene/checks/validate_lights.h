#pragma once

#include <bdpt/shared_scene_desc.h>

#include <string>

namespace bdpt {

/// Throws `Error` (invalid_input) for the first value of the lights and their profiles that no
/// scene can have. `reach`: how far from the origin lights may be [m].
void validate_lights(const SharedSceneDesc& desc, float reach);

/// How far things may be, and why: the end of a message.
[[nodiscard]] std::string limit_text(float reach);

}  // namespace bdpt
