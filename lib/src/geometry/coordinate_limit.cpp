#include "geometry/coordinate_limit.h"

#include "geometry/motion.h"

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace bdpt {
namespace {

/// Returns a bound of every coordinate of `m * v` for all v whose coordinates are at most 1.
double stretch(const glm::dmat3& m)
{
    const glm::dvec3 rows = abs(m[0]) + abs(m[1]) + abs(m[2]);
    return std::max({rows.x, rows.y, rows.z});
}

}  // namespace

float compute_coordinate_limit(std::span<const InstanceDesc> instances, std::size_t mesh_count)
{
    // Rays start at up to 8 times the reach, and their directions are up to 16 times as long.
    constexpr double in_object_space = 1e17;
    std::vector<int> uses(mesh_count, 0);
    for (const InstanceDesc& instance : instances) {
        int& count = uses[static_cast<std::size_t>(instance.mesh)];
        count = std::min(count + 1, 2);
    }
    double reach = static_cast<double>(max_coordinate);
    const auto bring_within = [&reach](double most) {
        reach = most * reach <= in_object_space ? reach : in_object_space / most;
    };
    for (const InstanceDesc& instance : instances) {
        if (uses[static_cast<std::size_t>(instance.mesh)] > 1) {
            bring_within(stretch(inverse(glm::dmat3(instance.world_from_object))));
        }
        const std::span<const Mat4> motion = instance.motion;
        for (std::size_t i = 0; i < motion.size(); ++i) {
            const Mat4& from = at_step(instance.world_from_object, motion, i);
            bring_within(motion_bounds(from, motion[i]).inverse_stretch);
        }
    }
    return std::isfinite(reach) ? static_cast<float>(reach) : 0.0f;
}

Vec3 compute_extent(const MeshDesc& mesh)
{
    Vec3 extent(0.0f);
    const auto take_in = [&extent](const std::vector<Vec3>& positions) {
        for (const Vec3& position : positions) {
            extent = max(extent, abs(position));
        }
    };
    take_in(mesh.positions);
    for (const MeshPose& pose : mesh.motion) {
        take_in(pose.positions);
    }
    return extent;
}

float placed_extent(Vec3 extent, const Mat4& world_from_object)
{
    const Mat4& m = world_from_object;
    const glm::dvec3 size = glm::dvec3(abs(m[0])) * static_cast<double>(extent.x) +
                            glm::dvec3(abs(m[1])) * static_cast<double>(extent.y) +
                            glm::dvec3(abs(m[2])) * static_cast<double>(extent.z) +
                            glm::dvec3(abs(m[3]));
    return static_cast<float>(std::max({size.x, size.y, size.z}));
}

}  // namespace bdpt
