#pragma once

#include <bdpt/scene_desc.h>

#include <glm/mat4x4.hpp>

#include <optional>

namespace bdpt::io {

/// A mesh with a transform that has no inverse applied to its positions, which no instance can do.
/// It gets face normals. None if no triangle with an area is left.
[[nodiscard]] std::optional<MeshDesc> place_mesh(const MeshDesc& mesh,
                                                 const glm::dmat4& world_from_object);

}  // namespace bdpt::io
