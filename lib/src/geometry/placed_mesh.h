#pragma once

#include "geometry/ray.h"
#include "math/footprint.h"

#include <bdpt/scene_desc.h>

#include <array>
#include <cstdint>

namespace bdpt {

/// A mesh as one instance places it in the world. Refers to the mesh, which must outlive it.
class PlacedMesh {
public:
    PlacedMesh(const MeshDesc& mesh, const Mat4& world_from_object);

    [[nodiscard]] const MeshDesc& mesh() const { return *mesh_; }
    [[nodiscard]] std::uint32_t triangle_count() const
    {
        return static_cast<std::uint32_t>(mesh_->triangles.size());
    }

    /// +1, or -1 when the transform mirrors: the front is then where the corners run clockwise
    /// (glTF 2.0, sec. 3.7.4 "Instantiation").
    [[nodiscard]] float front_sign() const { return front_sign_; }

    [[nodiscard]] Vec3 world_point(Vec3 object_point) const;
    [[nodiscard]] Vec3 world_vector(Vec3 object_vector) const { return linear_ * object_vector; }
    /// Keeps the side: the front in object space is the front in the world. Any length.
    [[nodiscard]] Vec3 world_normal(Vec3 object_normal) const
    {
        return normal_matrix_ * object_normal;
    }

    /// Corners in the world.
    [[nodiscard]] std::array<Vec3, 3> corners(std::uint32_t triangle) const;
    /// Barycentrics are those of the second and third corner.
    [[nodiscard]] BoundedPoint point(std::uint32_t triangle, Vec2 barycentrics) const;
    /// Where the line of the ray crosses the plane of the triangle. Embree knows it too, but from
    /// reciprocals that CPUs of different makers approximate differently; this is the same on all.
    [[nodiscard]] TriangleHit hit(std::uint32_t triangle, const Ray& ray) const;
    /// Front normal from the corners, in the world, unnormalised; its length is twice the area.
    [[nodiscard]] Vec3 area_normal(std::uint32_t triangle) const;

    [[nodiscard]] std::array<Vec2, 2> uv(std::uint32_t triangle, Vec2 barycentrics) const;
    /// What a pixel that is `width` wide [m] on the triangle covers of its texture coordinates;
    /// zero where the triangle has no area.
    [[nodiscard]] UvFootprint uv_footprint(std::uint32_t triangle, float width) const;
    /// Interpolated and unit; zero when the mesh has no normals.
    [[nodiscard]] Vec3 shading_normal(std::uint32_t triangle, Vec2 barycentrics) const;
    /// Tangent and handedness for normal maps: the mesh's own, else along texture coordinate u of
    /// set `uv_set`; zero when neither exists.
    [[nodiscard]] Vec4 tangent(std::uint32_t triangle, Vec2 barycentrics, int uv_set) const;
    [[nodiscard]] Vec4 color(std::uint32_t triangle, Vec2 barycentrics) const;

    /// From now on corners are read from `positions` (world space, one for each vertex).
    void use_world_positions(const Vec3* positions) { world_positions_ = positions; }

private:
    template <typename T>
    [[nodiscard]] T interpolate(const std::vector<T>& values, std::uint32_t triangle,
                                Vec2 barycentrics) const
    {
        const UVec3& i = mesh_->triangles[triangle];
        return (1.0f - barycentrics.x - barycentrics.y) * values[i.x] +
               barycentrics.x * values[i.y] + barycentrics.y * values[i.z];
    }

    const MeshDesc* mesh_;
    const Vec3* world_positions_ = nullptr;
    Mat3 linear_;
    Vec3 translation_;
    Mat3 normal_matrix_;
    float front_sign_;
};

}  // namespace bdpt
