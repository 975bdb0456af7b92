#pragma once

#include <bdpt/scene_desc.h>

#include <glm/mat4x4.hpp>

#include <optional>
#include <span>

namespace bdpt::io {

/// A mesh with a transform that has no inverse applied to its positions, which no instance can do;
/// or several, one for each time, and then it deforms: they and the steps of a mesh that deforms
/// are equally many. It gets face normals. None if no triangle with an area is ever left.
[[nodiscard]] std::optional<MeshDesc> place_mesh(const MeshDesc& mesh,
                                                 std::span<const glm::dmat4> world_from_object);

}  // namespace bdpt::io
