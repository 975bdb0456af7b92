#pragma once

#include "file/load_context.h"

#include <bdpt/scene_desc.h>

#include <glm/mat4x4.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace bdpt::io {

// `worlds`: transforms of node `node` at equally spaced times while the shutter is open, the first
// at its opening; empty: it stands still. A motion that cannot be linear, such as a jump, is
// dropped with a warning.

/// Returns `CameraDesc::motion`.
[[nodiscard]] std::vector<Mat4> camera_motion(std::span<const glm::dmat4> worlds, std::size_t node,
                                              LoadContext& context);

/// Makes a light that was read for the opening move with its node.
void move_light(LightDesc& light, std::span<const glm::dmat4> worlds, std::size_t node,
                LoadContext& context);

}  // namespace bdpt::io
