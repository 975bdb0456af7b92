#pragma once

#include <bdpt/scene_desc.h>

#include <glm/mat4x4.hpp>

#include <optional>
#include <span>

namespace bdpt::io {

/// Applies a transform without an inverse, which no instance can have, to the positions of a mesh;
/// or several, one per time, which makes the mesh deform: as many as the steps of a mesh that
/// already deforms. The result has face normals. Returns none if no triangle ever has an area.
[[nodiscard]] std::optional<MeshDesc> place_mesh(const MeshDesc& mesh,
                                                 std::span<const glm::dmat4> world_from_object);

}  // namespace bdpt::io
