#pragma once

#include "file/load_context.h"

#include <glm/mat4x4.hpp>
#include <tiny_gltf.h>

#include <cstddef>
#include <vector>

namespace bdpt::io {

/// Returns the transforms of the instances of a node's mesh by EXT_mesh_gpu_instancing, in the
/// node's space; the identity alone without the extension. Throws `Error` (invalid_input), also for
/// more than `most` instances, before any is read.
[[nodiscard]] std::vector<glm::dmat4> instance_transforms(const tinygltf::Model& model,
                                                          std::size_t node, std::size_t most,
                                                          LoadContext& context);

}  // namespace bdpt::io
