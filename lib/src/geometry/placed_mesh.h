#pragma once

#include "geometry/motion.h"
#include "geometry/ray.h"
#include "math/frame.h"

#include <bdpt/scene_desc.h>
#include <bdpt/types.h>

#include <glm/geometric.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace bdpt {

/// Returns the length of a vector, correct even if its square exceeds the range of floats: area
/// normals of triangles with edges of more than 4e9 m, or less than 1e-9 m, are that long or short.
[[nodiscard]] inline float compute_length(Vec3 v)
{
    const float squared = dot(v, v);
    if (squared >= std::numeric_limits<float>::min() &&
        squared <= std::numeric_limits<float>::max()) [[likely]] {
        return std::sqrt(squared);
    }
    const glm::dvec3 wide(v);
    return static_cast<float>(std::sqrt(dot(wide, wide)));
}

/// Precomputed data of a static triangle for each hit, in one cache line.
struct alignas(64) StillTriangle {
    Vec3 corner{0.0f};        ///< first vertex, in world space
    float error = 0.0f;       ///< as in `BoundedPoint`, for points given by barycentrics
    Vec3 to_b{0.0f};          ///< edge from the first to the second vertex
    Vec3 to_c{0.0f};          ///< edge from the first to the third vertex
    Vec3 ng{0.0f};            ///< unit, on the front; zero without an area
    float twice_area = 0.0f;  ///< negative if the front has clockwise vertices

    /// `front_sign` as in `PlacedMesh`.
    StillTriangle(const std::array<Vec3, 3>& corners, float front_sign, float error_of_points)
        : corner(corners[0]),
          error(error_of_points),
          to_b(corners[1] - corners[0]),
          to_c(corners[2] - corners[0])
    {
        const Vec3 normal = front_sign * cross(to_b, to_c);
        const float length = compute_length(normal);
        if (length > 0.0f) {
            ng = normal / length;
            twice_area = front_sign * length;
        }
    }

    [[nodiscard, gnu::always_inline]] inline BoundedPoint point(Vec2 barycentrics) const
    {
        return {corner + (barycentrics.x * to_b + barycentrics.y * to_c), error};
    }
    /// Intersects the line of the ray with the plane [Moeller and Trumbore 1997, "Fast, Minimum
    /// Storage Ray/Triangle Intersection"].
    [[gnu::always_inline]] inline void hit(const Ray& ray, TriangleHit& at) const
    {
        const float determinant = twice_area * dot(ng, ray.direction);
        const Vec3 moment = cross(ray.origin - corner, ray.direction);
        const float scale = determinant == 0.0f ? 0.0f : 1.0f / determinant;  // edge-on
        at.barycentrics = {-dot(moment, to_c) * scale, dot(moment, to_b) * scale};
        at.ng = ng;
        at.point = point(at.barycentrics);
    }
};

static_assert(sizeof(StillTriangle) == 64);

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

/// Maximum distance from the origin in each coordinate [m]: products of four such numbers overflow,
/// but products of two stay finite.
inline constexpr float max_coordinate = 1e15f;

/// Returns the maximum distance of surfaces and lights of a scene from the origin [m]. At most
/// `max_coordinate`, and less if a mesh that several instances share, or one that moves, is scaled
/// down very much: Embree transforms rays to the space of such a mesh, and terminates the process
/// if a coordinate exceeds 1.8e18 there.
[[nodiscard]] float compute_coordinate_limit(std::span<const InstanceDesc> instances,
                                             std::size_t mesh_count);

/// Returns the largest coordinate of the corners of a mesh's bounds, in all of its poses.
[[nodiscard]] Vec3 compute_extent(const MeshDesc& mesh);

/// Returns the largest coordinate that a mesh of this extent can have in the world [m].
[[nodiscard]] float placed_extent(Vec3 extent, const Mat4& world_from_object);

}  // namespace bdpt
