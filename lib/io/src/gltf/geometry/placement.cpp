#include "gltf/geometry/placement.h"

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <utility>
#include <vector>

namespace bdpt::io {

namespace {

std::vector<Vec3> placed(std::vector<Vec3> positions, const glm::dmat4& world_from_object)
{
    for (Vec3& position : positions) {
        position = Vec3(world_from_object * glm::dvec4(glm::dvec3(position), 1.0));
    }
    return positions;
}

bool any_area(const std::vector<UVec3>& triangles, const std::vector<Vec3>& positions)
{
    return std::any_of(triangles.begin(), triangles.end(), [&positions](const UVec3& triangle) {
        const Vec3 a = positions[triangle.x];
        return glm::cross(positions[triangle.y] - a, positions[triangle.z] - a) != Vec3(0.0f);
    });
}

}  // namespace

std::optional<MeshDesc> place_mesh(const MeshDesc& mesh,
                                   std::span<const glm::dmat4> world_from_object)
{
    MeshDesc result = mesh;
    result.normals.clear();
    result.tangents.clear();
    result.motion.clear();
    result.positions = placed(mesh.positions, world_from_object.front());
    bool any = any_area(result.triangles, result.positions);
    double side = glm::determinant(glm::dmat3(world_from_object.front()));
    for (std::size_t step = 1; step < world_from_object.size(); ++step) {
        const bool deforms = !mesh.motion.empty();
        MeshPose pose;
        pose.positions = placed(deforms ? mesh.motion[step - 1].positions : mesh.positions,
                                world_from_object[step]);
        any = any || any_area(result.triangles, pose.positions);
        side = side != 0.0 ? side : glm::determinant(glm::dmat3(world_from_object[step]));
        result.motion.push_back(std::move(pose));
    }
    if (side < 0.0) {
        // A mirroring transform makes the corners clockwise; there is no instance to undo that
        // here.
        for (UVec3& triangle : result.triangles) {
            std::swap(triangle.y, triangle.z);
        }
    }
    return any ? std::optional(std::move(result)) : std::nullopt;
}

}  // namespace bdpt::io
