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

/// Returns the origin that a world needs whose coordinates are far larger than it, as on a map: its
/// centre, along those axes where it lies far away. All bits of the coordinates remain when it is
/// subtracted. None: an ordinary scene. It is zero if only the meshes have such coordinates, which
/// their instances undo.
[[nodiscard]] std::optional<DVec3> distant_origin(const SceneDesc& scene);

/// Subtracts the centre of a mesh from its positions, along those axes where it lies far away;
/// returns what was subtracted, which its instances must add.
[[nodiscard]] DVec3 recenter(MeshDesc& mesh);

}  // namespace bdpt::io
