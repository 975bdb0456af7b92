#pragma once

#include "geometry/motion.h"
#include "geometry/ray.h"
#include "geometry/still_triangle.h"
#include "math/frame.h"

#include <bdpt/scene_desc.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace bdpt {

/// A transform of points, vectors and normals.
struct Placement {
    explicit Placement(const Mat4& world_from_object);

    [[nodiscard]] Vec3 point(Vec3 object_point) const
    {
        return linear * object_point + translation;
    }

    Mat3 linear;
    Vec3 translation;
    Mat3 normal_matrix;
    float front_sign;  ///< -1 if it mirrors, else +1
};

/// Returns a bound of the error of points on triangles that reach `extent` from the origin [m], in
/// one coordinate.
[[nodiscard]] float position_error(float extent);

/// A mesh as placed in the world by one instance. Refers to both, which must outlive it. Times are
/// within the shutter interval [0, 1], and matter if something moves.
///
/// Motion follows Embree: linear interpolation between steps, of matrices for a rigid mesh, of
/// world-space vertices for a deforming one.
class PlacedMesh {
public:
    PlacedMesh(const MeshDesc& mesh, const InstanceDesc& instance);
    /// Places a mesh with a static transform.
    PlacedMesh(const MeshDesc& mesh, const Mat4& world_from_object);

    [[nodiscard]] const MeshDesc& mesh() const { return *mesh_; }
    [[nodiscard]] std::uint32_t triangle_count() const
    {
        return static_cast<std::uint32_t>(mesh_->triangles.size());
    }

    /// Returns +1, or -1 if the transform mirrors: the front then has clockwise vertices (glTF 2.0,
    /// sec. 3.7.4 "Instantiation").
    [[nodiscard]] float front_sign() const { return first_.front_sign; }

    /// Tests whether it deforms, or its instance moves.
    [[nodiscard]] bool moves() const { return steps_ > 0; }
    [[nodiscard]] bool deforms() const { return !mesh_->motion.empty(); }
    /// Returns the number of motion steps after shutter open; 0 if static.
    [[nodiscard]] std::size_t steps() const { return steps_; }
    /// Returns the transform, or a vertex in world space, at step `step` in [0, steps()].
    [[nodiscard]] const Mat4& transform_at(std::size_t step) const;
    [[nodiscard]] Vec3 world_point_at(std::size_t step, std::size_t vertex) const;

    // At shutter open.
    [[nodiscard]] Vec3 world_point(Vec3 object_point) const { return first_.point(object_point); }
    [[nodiscard]] Vec3 world_vector(Vec3 object_vector) const
    {
        return first_.linear * object_vector;
    }
    /// Transforms a normal, preserving the side: the front in object space is the front in the
    /// world. Any length.
    [[nodiscard]] Vec3 world_normal(Vec3 object_normal) const
    {
        return first_.normal_matrix * object_normal;
    }

    /// Returns the vertices of a triangle in world space.
    [[nodiscard]] std::array<Vec3, 3> corners(std::uint32_t triangle, float time) const;
    /// Returns a point; barycentrics are the weights of the second and third vertex.
    [[nodiscard]] BoundedPoint point(std::uint32_t triangle, Vec2 barycentrics, float time) const
    {
        return settled_.empty() ? unsettled_point(triangle, barycentrics, time)
                                : settled_[triangle].point(barycentrics);
    }
    /// Intersects the line of the ray with the plane of the triangle and stores the result in `at`.
    /// Embree computes it too, but from reciprocals that CPUs of different vendors approximate
    /// differently; this is bit-identical on all.
    void hit(std::uint32_t triangle, const Ray& ray, TriangleHit& at) const
    {
        __builtin_prefetch(&mesh_->triangles[triangle]);  // for the surface at the hit
        if (settled_.empty()) {
            unsettled_hit(triangle, ray, at);
        } else {
            settled_[triangle].hit(ray, at);
        }
    }
    /// Returns the front normal of the triangle in world space, unnormalised; its length is twice
    /// the area.
    [[nodiscard]] Vec3 area_normal(std::uint32_t triangle, float time) const;

    [[nodiscard]] std::array<Vec2, 2> uv(std::uint32_t triangle, Vec2 barycentrics) const;
    /// Returns the texture footprint of a pixel that is `width` wide [m] on the triangle; zero if
    /// the triangle has no area.
    [[nodiscard]] UvFootprint uv_footprint(std::uint32_t triangle, float width, float time) const;
    /// Returns the interpolated unit normal; zero if the mesh has no normals.
    [[nodiscard]] Vec3 shading_normal(std::uint32_t triangle, Vec2 barycentrics, float time) const;
    /// Returns tangent and handedness for normal maps: the mesh's own, else along texture
    /// coordinate u of set `uv_set`; zero if neither exists.
    [[nodiscard]] Vec4 tangent(std::uint32_t triangle, Vec2 barycentrics, int uv_set,
                               float time) const;
    [[nodiscard]] Vec4 color(std::uint32_t triangle, Vec2 barycentrics) const;

    /// Precomputes hits of a static mesh with a single instance. Vertices are read from `positions`
    /// from now on (world space, one for each vertex), which must outlive this.
    void settle(std::span<const Vec3> positions);

private:
    /// A triangle in world space at a time.
    struct Moment {
        std::array<Vec3, 3> corners;
        float error;  ///< as in `BoundedPoint`
    };
    [[nodiscard]] Moment rigid_moment(const UVec3& vertices, float time) const;
    [[nodiscard]] Moment deforming_moment(const UVec3& vertices, float time) const;
    [[nodiscard]] Moment moment(std::uint32_t triangle, float time) const;
    [[nodiscard]] Placement placement(float time) const;
    [[nodiscard]] Moment still_moment(std::uint32_t triangle) const;
    [[nodiscard]] BoundedPoint unsettled_point(std::uint32_t triangle, Vec2 barycentrics,
                                               float time) const;
    void unsettled_hit(std::uint32_t triangle, const Ray& ray, TriangleHit& at) const;

    template <typename T>
    [[nodiscard]] T interpolate(const std::vector<T>& values, std::uint32_t triangle,
                                Vec2 barycentrics) const
    {
        const UVec3& i = mesh_->triangles[triangle];
        return (1.0f - barycentrics.x - barycentrics.y) * values[i.x] +
               barycentrics.x * values[i.y] + barycentrics.y * values[i.z];
    }
    /// Interpolates an attribute that moves with the mesh: `first` at shutter open, `later` in each
    /// pose.
    template <typename T>
    [[nodiscard]] T interpolate(const std::vector<T>& first, std::vector<T> MeshPose::*later,
                                std::uint32_t triangle, Vec2 barycentrics, float time) const
    {
        if (!deforms()) {
            return interpolate(first, triangle, barycentrics);
        }
        const TimeStep step = time_step(time, mesh_->motion.size());
        const auto& from = step.index == 0 ? first : mesh_->motion[step.index - 1].*later;
        const auto& to = mesh_->motion[step.index].*later;
        return between(interpolate(from, triangle, barycentrics),
                       interpolate(to, triangle, barycentrics), step.fraction);
    }

    const MeshDesc* mesh_;
    std::span<const Vec3> world_positions_;  // set once settled
    std::vector<StillTriangle> settled_;     // set once settled
    std::size_t steps_;
    Placement first_;  // at shutter open
    Mat4 transform_;   // at shutter open
    std::span<const Mat4> motion_;
};

}  // namespace bdpt
