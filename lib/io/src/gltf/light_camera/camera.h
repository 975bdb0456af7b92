#pragma once

#include "file/load_context.h"

#include <bdpt/scene_desc.h>

#include <tiny_gltf.h>
#include <glm/mat4x4.hpp>

#include <cstddef>
#include <optional>

namespace bdpt::io {

/// Returns the pose of a camera in its node: upside down if both extents are negative.
[[nodiscard]] glm::dmat4 node_from_camera(const tinygltf::Camera& camera);

/// Reads the camera of a node; none if it has none, or, with a warning, one that cannot be
/// rendered.
[[nodiscard]] std::optional<CameraDesc> read_camera(const tinygltf::Model& model, std::size_t node,
                                                    const glm::dmat4& world_from_node,
                                                    LoadContext& context);

}  // namespace bdpt::io
