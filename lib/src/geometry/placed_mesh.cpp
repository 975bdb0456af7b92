#include "geometry/placed_mesh.h"

#include "geometry/rounding.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>

namespace bdpt {
namespace {

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
    const UVec3& i = mesh_->triangles[triangle];
    const Vec3* corner = world_positions_ != nullptr ? world_positions_ : mesh_->positions.data();
    const float b0 = 1.0f - barycentrics.x - barycentrics.y;
    const Vec3 q0 = b0 * corner[i.x];
    const Vec3 q1 = barycentrics.x * corner[i.y];
    const Vec3 q2 = barycentrics.y * corner[i.z];
    const Vec3 p = q0 + q1 + q2;
    const Vec3 size = abs(q0) + abs(q1) + abs(q2);
    if (world_positions_ != nullptr) {
        return {p, rounding_bound(7) * size};
    }
    // Each world coordinate is a sum of four products, of a point that already has an error.
    const Mat3 size_matrix(abs(linear_[0]), abs(linear_[1]), abs(linear_[2]));
    return {world_point(p), rounding_bound(12) * (size_matrix * size + abs(translation_))};
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
