#include "gltf/placement.h"

#include <glm/geometric.hpp>

#include <algorithm>

namespace bdpt::io {

std::optional<MeshDesc> place_mesh(const MeshDesc& mesh, const glm::dmat4& world_from_object)
{
    MeshDesc placed = mesh;
    placed.normals.clear();
    placed.tangents.clear();
    for (Vec3& position : placed.positions) {
        position = Vec3(world_from_object * glm::dvec4(glm::dvec3(position), 1.0));
    }
    const bool any_area = std::any_of(
        placed.triangles.begin(), placed.triangles.end(), [&placed](const UVec3& triangle) {
            const Vec3 a = placed.positions[triangle.x];
            return glm::cross(placed.positions[triangle.y] - a, placed.positions[triangle.z] - a) !=
                   Vec3(0.0f);
        });
    return any_area ? std::optional(std::move(placed)) : std::nullopt;
}

}  // namespace bdpt::io
