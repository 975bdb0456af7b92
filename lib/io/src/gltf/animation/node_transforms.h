#pragma once

#include "file/load_context.h"

#include <bdpt/types.h>

#include <tiny_gltf.h>
#include <glm/mat4x4.hpp>

#include <cstddef>
#include <optional>
#include <vector>

namespace bdpt::io {

/// World transforms of all nodes, computed on demand.
class NodeTransforms {
public:
    /// The arguments must outlive this object. The nodes must be a forest (check_node_graph).
    /// `origin`: the world's origin in the coordinates of the file.
    NodeTransforms(const tinygltf::Model& model, const DVec3& origin, LoadContext& context);

    /// Returns node space to world space. Throws `Error` (invalid_input) if it is not finite.
    [[nodiscard]] const glm::dmat4& world(std::size_t node);

private:
    const tinygltf::Model& model_;
    DVec3 origin_;
    LoadContext& context_;
    std::vector<std::size_t> parents_;
    std::vector<std::optional<glm::dmat4>> world_;
};

}  // namespace bdpt::io
