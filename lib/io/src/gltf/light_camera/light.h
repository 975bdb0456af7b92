#pragma once

#include "file/load_context.h"

#include <bdpt/scene_desc.h>

#include <glm/mat4x4.hpp>
#include <tiny_gltf.h>

#include <cstddef>
#include <optional>

namespace bdpt::io {

/// Reads the KHR_lights_punctual light of a node, if any. Units are those of the extension: candela
/// and lux; `extras.radius` [m] of a point or spot light is scaled by the node's mean scale. Throws
/// `Error` (unsupported) for an unknown type.
[[nodiscard]] std::optional<LightDesc> read_light(const tinygltf::Model& model, std::size_t node,
                                                  const glm::dmat4& world_from_node,
                                                  LoadContext& context);

}  // namespace bdpt::io
