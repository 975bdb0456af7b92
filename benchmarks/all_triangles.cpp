#include "all_triangles.h"

#include <glm/geometric.hpp>

#include <cstddef>

namespace bdpt {

AllTriangles::AllTriangles(const SceneDesc& scene)
{
    for (const InstanceDesc& instance : scene.instances) {
        const MeshDesc& mesh = scene.meshes[static_cast<std::size_t>(instance.mesh)];
        const auto corner = [&](unsigned int index) {
            return Vec3(instance.world_from_object * Vec4(mesh.positions[index], 1.0f));
        };
        for (const UVec3& triangle : mesh.triangles) {
            const Vec3 a = corner(triangle.x);
            triangles_.push_back(
                {.corner = a, .edge1 = corner(triangle.y) - a, .edge2 = corner(triangle.z) - a});
        }
    }
}

bool AllTriangles::is_hit_by(const RecordedRay& ray) const
{
    float nearest = ray.t_far;
    for (const Triangle& triangle : triangles_) {
        const Vec3 p = cross(ray.direction, triangle.edge2);
        const float determinant = dot(triangle.edge1, p);
        if (determinant == 0.0f) {
            continue;
        }
        const float inverse = 1.0f / determinant;
        const Vec3 from_corner = ray.origin - triangle.corner;
        const float u = dot(from_corner, p) * inverse;
        if (!(u >= 0.0f && u <= 1.0f)) {
            continue;
        }
        const Vec3 q = cross(from_corner, triangle.edge1);
        const float v = dot(ray.direction, q) * inverse;
        const float t = dot(triangle.edge2, q) * inverse;
        if (v >= 0.0f && u + v <= 1.0f && t >= ray.t_near && t < nearest) {
            if (ray.query == RayQuery::any_hit) {
                return true;
            }
            nearest = t;
        }
    }
    return nearest < ray.t_far;
}

}  // namespace bdpt
