#include "geometry/placed_mesh.h"

#include "geometry/rounding.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>

namespace bdpt {
namespace {

/// How often a coordinate of a point, or of an intersection test, is rounded at most.
constexpr int rounded_operations = 12;

float max_axis(Vec3 v)
{
    return std::max(v.x, std::max(v.y, v.z));
}

/// From products of Pluecker coordinates relative to the ray's origin.
Vec2 barycentrics_of(const std::array<Vec3, 3>& corners, const Ray& ray)
{
    const Vec3 a = corners[0] - ray.origin;
    const Vec3 b = corners[1] - ray.origin;
    const Vec3 c = corners[2] - ray.origin;
    const float of_b = dot(cross(c - a, c + a), ray.direction);
    const float of_c = dot(cross(a - b, a + b), ray.direction);
    const float of_a = dot(cross(b - c, b + c), ray.direction);
    const float sum = of_a + of_b + of_c;
    if (sum == 0.0f) {
        return Vec2(0.0f);  // seen from the side
    }
    return {of_b / sum, of_c / sum};
}

/// The greatest coordinate of all corners.
Vec3 extent(const std::array<Vec3, 3>& corners)
{
    return max(abs(corners[0]), max(abs(corners[1]), abs(corners[2])));
}

Vec3 interpolated(const std::array<Vec3, 3>& corners, Vec2 barycentrics)
{
    return (1.0f - barycentrics.x - barycentrics.y) * corners[0] + barycentrics.x * corners[1] +
           barycentrics.y * corners[2];
}

/// Of corners as Embree has them. The intersection test works on the corners relative to the ray's
/// origin and rounds in all directions, even where a coordinate of all corners is zero. So the
/// bound takes the greatest coordinate of all, not each axis for itself.
BoundedPoint bounded_point(const std::array<Vec3, 3>& corners, Vec2 barycentrics)
{
    return {interpolated(corners, barycentrics),
            rounding_bound(rounded_operations) * max_axis(extent(corners))};
}

/// Transposed cofactors: the inverse transpose times the determinant, so it cannot divide by zero.
Mat3 cofactors(const Mat3& m)
{
    return {cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])};
}

}  // namespace

PlacedMesh::PlacedMesh(const MeshDesc& mesh, const Mat4& world_from_object)
    : mesh_(&mesh),
      linear_(world_from_object),
      translation_(world_from_object[3]),
      front_sign_(std::copysign(1.0f, glm::determinant(linear_)))
{
    normal_matrix_ = front_sign_ * cofactors(linear_);
}

Vec3 PlacedMesh::world_point(Vec3 object_point) const
{
    return linear_ * object_point + translation_;
}

std::array<Vec3, 3> PlacedMesh::corners(std::uint32_t triangle) const
{
    const UVec3& i = mesh_->triangles[triangle];
    if (world_positions_ != nullptr) {
        return {world_positions_[i.x], world_positions_[i.y], world_positions_[i.z]};
    }
    const auto& p = mesh_->positions;
    return {world_point(p[i.x]), world_point(p[i.y]), world_point(p[i.z])};
}

BoundedPoint PlacedMesh::point(std::uint32_t triangle, Vec2 barycentrics) const
{
    if (world_positions_ != nullptr) {
        return bounded_point(corners(triangle), barycentrics);
    }
    const UVec3& i = mesh_->triangles[triangle];
    const auto& p = mesh_->positions;
    const std::array<Vec3, 3> in_object{p[i.x], p[i.y], p[i.z]};
    const Mat3 magnitudes(abs(linear_[0]), abs(linear_[1]), abs(linear_[2]));
    const Vec3 world_size = magnitudes * extent(in_object) + abs(translation_);
    return {world_point(interpolated(in_object, barycentrics)),
            rounding_bound(2 * rounded_operations) * max_axis(world_size)};
}

TriangleHit PlacedMesh::hit(std::uint32_t triangle, const Ray& ray) const
{
    const std::array<Vec3, 3> corners = this->corners(triangle);
    const Vec2 barycentrics = barycentrics_of(corners, ray);
    return {.barycentrics = barycentrics,
            .normal = front_sign_ * cross(corners[1] - corners[0], corners[2] - corners[0]),
            .point = world_positions_ != nullptr ? bounded_point(corners, barycentrics)
                                                 : point(triangle, barycentrics)};
}

Vec3 PlacedMesh::area_normal(std::uint32_t triangle) const
{
    const auto [a, b, c] = corners(triangle);
    return front_sign_ * cross(b - a, c - a);
}

std::array<Vec2, 2> PlacedMesh::uv(std::uint32_t triangle, Vec2 barycentrics) const
{
    std::array<Vec2, 2> result{};
    for (std::size_t set = 0; set < 2; ++set) {
        if (!mesh_->uvs[set].empty()) {
            result[set] = interpolate(mesh_->uvs[set], triangle, barycentrics);
        }
    }
    return result;
}

UvFootprint PlacedMesh::uv_footprint(std::uint32_t triangle, float width) const
{
    UvFootprint result;
    const auto [a, b, c] = corners(triangle);
    const Vec3 first = b - a;
    const Vec3 second = c - a;
    const float length_squared = dot(first, first);
    const float shift = dot(first, second) / length_squared;
    const Vec3 level = second - shift * first;
    const float height_squared = dot(level, level);
    if (!(length_squared > 0.0f && height_squared > 0.0f)) {
        return result;
    }
    const UVec3& i = mesh_->triangles[triangle];
    for (std::size_t set = 0; set < 2; ++set) {
        const std::vector<Vec2>& uvs = mesh_->uvs[set];
        if (!uvs.empty()) {
            const Vec2 along = uvs[i.y] - uvs[i.x];
            const Vec2 across = uvs[i.z] - uvs[i.x] - shift * along;
            result[set] = {.along = width / std::sqrt(length_squared) * along,
                           .across = width / std::sqrt(height_squared) * across};
        }
    }
    return result;
}

Vec3 PlacedMesh::shading_normal(std::uint32_t triangle, Vec2 barycentrics) const
{
    if (mesh_->normals.empty()) {
        return Vec3(0.0f);
    }
    const Vec3 n = world_normal(interpolate(mesh_->normals, triangle, barycentrics));
    const float length_squared = dot(n, n);
    return length_squared > 0.0f ? n / std::sqrt(length_squared) : Vec3(0.0f);
}

Vec4 PlacedMesh::tangent(std::uint32_t triangle, Vec2 barycentrics, int uv_set) const
{
    if (!mesh_->tangents.empty()) {
        const Vec4 t = interpolate(mesh_->tangents, triangle, barycentrics);
        return {world_vector(Vec3(t)), std::copysign(front_sign_, front_sign_ * t.w)};
    }
    const auto& uvs = mesh_->uvs[static_cast<std::size_t>(uv_set)];
    if (uvs.empty()) {
        return Vec4(0.0f);
    }
    const UVec3& i = mesh_->triangles[triangle];
    const auto [a, b, c] = corners(triangle);
    const Vec2 d1 = uvs[i.y] - uvs[i.x];
    const Vec2 d2 = uvs[i.z] - uvs[i.x];
    const float area = d1.x * d2.y - d1.y * d2.x;  // signed, of the triangle in the texture
    if (area == 0.0f) {
        return Vec4(0.0f);
    }
    const Vec3 along_u = std::copysign(1.0f, area) * (d2.y * (b - a) - d1.y * (c - a));
    // v grows downwards in glTF and the bitangent points up in the picture. A triangle that is not
    // mirrored in the texture has its corners clockwise there, so the area is negative.
    return {along_u, -std::copysign(front_sign_, area * front_sign_)};
}

Vec4 PlacedMesh::color(std::uint32_t triangle, Vec2 barycentrics) const
{
    return mesh_->colors.empty() ? Vec4(1.0f) : interpolate(mesh_->colors, triangle, barycentrics);
}

}  // namespace bdpt
