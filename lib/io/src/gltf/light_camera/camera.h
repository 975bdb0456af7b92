#pragma once

#include "file/load_context.h"
#include "gltf/document/tinygltf.h"

#include <bdpt/scene_desc.h>

#include <glm/mat4x4.hpp>

#include <cstddef>
#include <optional>

namespace bdpt::io {

/// The camera that a node holds, if it holds one that can be rendered; else a warning.
[[nodiscard]] std::optional<CameraDesc> read_camera(const tinygltf::Model& model, std::size_t node,
                                                    const glm::dmat4& world_from_node,
                                                    LoadContext& context);

}  // namespace bdpt::io
