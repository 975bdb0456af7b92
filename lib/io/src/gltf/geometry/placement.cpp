#include "gltf/geometry/mesh_table.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
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

/// A box along the axes.
struct Extents {
    DVec3 min{std::numeric_limits<double>::infinity()};
    DVec3 max{-std::numeric_limits<double>::infinity()};

    [[nodiscard]] DVec3 center() const { return 0.5 * (min + max); }
    [[nodiscard]] DVec3 half() const { return 0.5 * (max - min); }
    [[nodiscard]] double size() const
    {
        const DVec3 extent = half();
        return std::max({extent.x, extent.y, extent.z});
    }
    void add(const DVec3& low, const DVec3& high)
    {
        min = glm::min(min, low);
        max = glm::max(max, high);
    }
};

Extents extents_of(const std::vector<Vec3>& positions)
{
    Extents result;
    for (const Vec3& position : positions) {
        result.add(DVec3(position), DVec3(position));
    }
    return result;
}

/// A scene is far away at this distance over half of its size: it has five bits less of precision.
constexpr double far_away = 32.0;

/// Returns the centre of a box along the axes where it is far from zero, else zero. It is rounded
/// to a power of two, so that single precision holds the differences of coordinates exactly.
DVec3 distant_center(const Extents& box)
{
    constexpr double most = 1e14;  // Beyond, scenes are refused.
    const double size = box.size();
    const DVec3 center = box.center();
    DVec3 result(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        const double distance = std::abs(center[axis]);
        if (size > 0.0 && distance > far_away * size && distance < most) {
            const double step = std::scalbn(1.0, std::ilogb(size));
            result[axis] = std::round(center[axis] / step) * step;
        }
    }
    return result;
}

}  // namespace

std::optional<DVec3> distant_origin(const SceneDesc& scene)
{
    std::vector<Extents> of_meshes;
    of_meshes.reserve(scene.meshes.size());
    for (const MeshDesc& mesh : scene.meshes) {
        of_meshes.push_back(extents_of(mesh.positions));
    }
    Extents all;
    Extents places;
    for (const InstanceDesc& instance : scene.instances) {
        const glm::dmat4 world(instance.world_from_object);
        const Extents& mesh = of_meshes[static_cast<std::size_t>(instance.mesh)];
        const DVec3 half = mesh.half();
        const DVec3 center(world * glm::dvec4(mesh.center(), 1.0));
        const DVec3 reach = glm::abs(DVec3(world[0])) * half.x +
                            glm::abs(DVec3(world[1])) * half.y + glm::abs(DVec3(world[2])) * half.z;
        all.add(center - reach, center + reach);
        places.add(DVec3(world[3]), DVec3(world[3]));
    }
    if (!(all.size() > 0.0)) {
        return std::nullopt;
    }
    const DVec3 origin = distant_center(all);
    const DVec3 apart = glm::max(all.center() - places.min, places.max - all.center());
    const bool are_undone = std::max({apart.x, apart.y, apart.z}) > far_away * all.size();
    return origin != DVec3(0.0) || are_undone ? std::optional(origin) : std::nullopt;
}

DVec3 recenter(MeshDesc& mesh)
{
    const DVec3 center = distant_center(extents_of(mesh.positions));
    const auto subtract = [&center](std::vector<Vec3>& positions) {
        for (Vec3& position : positions) {
            position = Vec3(DVec3(position) - center);
        }
    };
    subtract(mesh.positions);
    for (MeshPose& pose : mesh.motion) {
        subtract(pose.positions);
    }
    return center;
}

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
