#include "geometry/placed_mesh.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace bdpt {
namespace {

/// Maximum number of roundings of a coordinate of a point, or of an intersection test.
constexpr int rounded_operations = 12;

float max_axis(Vec3 v)
{
    return std::max(v.x, std::max(v.y, v.z));
}

/// Returns the largest coordinates of all vertices.
Vec3 extent(const std::array<Vec3, 3>& corners)
{
    return max(abs(corners[0]), max(abs(corners[1]), abs(corners[2])));
}

/// Returns the error bound for vertices as Embree stores them. The intersection test works on the
/// vertices relative to the ray's origin and rounds in all directions, even where a coordinate of
/// all vertices is zero. So the bound uses the largest coordinate of all, not each axis separately.
float still_error(const std::array<Vec3, 3>& corners)
{
    return rounding_bound(rounded_operations) * max_axis(extent(corners));
}

/// Returns the error bound of a vertex that moves by `way` in one of `steps` steps and is at most
/// `size` from the origin. Both this code and Embree interpolate, and a rigid mesh is tested in its
/// own space; the error of the time within a step grows with the number of steps.
float moving_error(Vec3 size, Vec3 way, std::size_t steps)
{
    return rounding_bound(3 * rounded_operations) * max_axis(size) +
           rounding_bound(4 * static_cast<int>(steps)) * max_axis(way);
}

/// Returns the transposed cofactors: the inverse transpose times the determinant, so it cannot
/// divide by zero.
Mat3 cofactors(const Mat3& m)
{
    return {cross(m[1], m[2]), cross(m[2], m[0]), cross(m[0], m[1])};
}

/// Returns a bound of every coordinate of `m * v` for all v whose coordinates are at most 1.
double stretch(const glm::dmat3& m)
{
    const glm::dvec3 rows = abs(m[0]) + abs(m[1]) + abs(m[2]);
    return std::max({rows.x, rows.y, rows.z});
}

}  // namespace

float position_error(float extent)
{
    return rounding_bound(rounded_operations) * extent;
}

Placement::Placement(const Mat4& world_from_object)
    : linear(world_from_object),
      translation(world_from_object[3]),
      front_sign(std::copysign(1.0f, glm::determinant(linear)))
{
    normal_matrix = front_sign * cofactors(linear);
}

PlacedMesh::PlacedMesh(const MeshDesc& mesh, const InstanceDesc& instance)
    : PlacedMesh(mesh, instance.world_from_object)
{
    motion_ = instance.motion;
    steps_ = std::max(steps_, motion_.size());
}

PlacedMesh::PlacedMesh(const MeshDesc& mesh, const Mat4& world_from_object)
    : mesh_(&mesh),
      steps_(mesh.motion.size()),
      first_(world_from_object),
      transform_(world_from_object)
{}

const Mat4& PlacedMesh::transform_at(std::size_t step) const
{
    return at_step(transform_, motion_, step);
}

Vec3 PlacedMesh::world_point_at(std::size_t step, std::size_t vertex) const
{
    const bool at_first = step == 0 || !deforms();
    const auto& positions = at_first ? mesh_->positions : mesh_->motion[step - 1].positions;
    const Mat4& transform = transform_at(step);
    return Mat3(transform) * positions[vertex] + Vec3(transform[3]);
}

Placement PlacedMesh::placement(float time) const
{
    return motion_.empty() ? first_ : Placement(at_time(transform_, motion_, time));
}

PlacedMesh::Moment PlacedMesh::rigid_moment(const UVec3& vertices, float time) const
{
    const TimeStep step = time_step(time, steps_);
    const Mat4& from = transform_at(step.index);
    const Mat4& to = transform_at(step.index + 1);
    const Placement placement(between(from, to, step.fraction));
    const auto& p = mesh_->positions;
    const std::array<Vec3, 3> in_object{p[vertices.x], p[vertices.y], p[vertices.z]};
    const Vec3 size = extent(in_object);
    const auto stretched = [&size](const Mat4& m) {
        return abs(Vec3(m[0])) * size.x + abs(Vec3(m[1])) * size.y + abs(Vec3(m[2])) * size.z +
               abs(Vec3(m[3]));
    };
    return {
        .corners = {placement.point(in_object[0]), placement.point(in_object[1]),
                    placement.point(in_object[2])},
        .error = moving_error(max(stretched(from), stretched(to)), stretched(to - from), steps_)};
}

PlacedMesh::Moment PlacedMesh::deforming_moment(const UVec3& vertices, float time) const
{
    const TimeStep step = time_step(time, steps_);
    Moment moment{};
    Vec3 size(0.0f);
    Vec3 way(0.0f);
    for (std::size_t corner = 0; corner < 3; ++corner) {
        const std::size_t vertex = vertices[static_cast<int>(corner)];
        const Vec3 from = world_point_at(step.index, vertex);
        const Vec3 to = world_point_at(step.index + 1, vertex);
        moment.corners[corner] = between(from, to, step.fraction);
        size = max(size, max(abs(from), abs(to)));
        way = max(way, abs(to - from));
    }
    moment.error = moving_error(size, way, steps_);
    return moment;
}

/// Returns a triangle of a shared mesh, which is tested in its own space.
PlacedMesh::Moment PlacedMesh::still_moment(std::uint32_t triangle) const
{
    const UVec3& i = mesh_->triangles[triangle];
    if (!world_positions_.empty()) {
        const std::array<Vec3, 3> corners{world_positions_[i.x], world_positions_[i.y],
                                          world_positions_[i.z]};
        return {corners, still_error(corners)};
    }
    const auto& p = mesh_->positions;
    const std::array<Vec3, 3> in_object{p[i.x], p[i.y], p[i.z]};
    const Mat3& linear = first_.linear;
    const Mat3 magnitudes(abs(linear[0]), abs(linear[1]), abs(linear[2]));
    const Vec3 world_size = magnitudes * extent(in_object) + abs(first_.translation);
    return {{world_point(in_object[0]), world_point(in_object[1]), world_point(in_object[2])},
            rounding_bound(2 * rounded_operations) * max_axis(world_size)};
}

PlacedMesh::Moment PlacedMesh::moment(std::uint32_t triangle, float time) const
{
    if (!moves()) {
        return still_moment(triangle);
    }
    const UVec3& vertices = mesh_->triangles[triangle];
    return deforms() ? deforming_moment(vertices, time) : rigid_moment(vertices, time);
}

void PlacedMesh::settle(std::span<const Vec3> positions)
{
    world_positions_ = positions;
    settled_.reserve(mesh_->triangles.size());
    for (std::uint32_t triangle = 0; triangle < triangle_count(); ++triangle) {
        const auto [corners, error] = still_moment(triangle);
        settled_.emplace_back(corners, front_sign(), error);
    }
}

std::array<Vec3, 3> PlacedMesh::corners(std::uint32_t triangle, float time) const
{
    return moment(triangle, time).corners;
}

BoundedPoint PlacedMesh::unsettled_point(std::uint32_t triangle, Vec2 barycentrics,
                                         float time) const
{
    const auto [corners, error] = moment(triangle, time);
    return StillTriangle(corners, front_sign(), error).point(barycentrics);
}

void PlacedMesh::unsettled_hit(std::uint32_t triangle, const Ray& ray, TriangleHit& at) const
{
    const auto [corners, error] = moment(triangle, ray.segment.time);
    StillTriangle(corners, front_sign(), error).hit(ray, at);
}

Vec3 PlacedMesh::area_normal(std::uint32_t triangle, float time) const
{
    const auto [a, b, c] = corners(triangle, time);
    return front_sign() * cross(b - a, c - a);
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

UvFootprint PlacedMesh::uv_footprint(std::uint32_t triangle, float width, float time) const
{
    UvFootprint result;
    const auto [a, b, c] = corners(triangle, time);
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

Vec3 PlacedMesh::shading_normal(std::uint32_t triangle, Vec2 barycentrics, float time) const
{
    if (mesh_->normals.empty()) {
        return Vec3(0.0f);
    }
    if (const std::vector<Vec2>& uvs = mesh_->uvs[0]; !uvs.empty()) {
        const UVec3& i = mesh_->triangles[triangle];
        for (const std::uint32_t vertex : {i.x, i.y, i.z}) {
            __builtin_prefetch(&uvs[vertex]);  // looked up next
        }
    }
    const Vec3 n =
        moves() ? placement(time).normal_matrix *
                      interpolate(mesh_->normals, &MeshPose::normals, triangle, barycentrics, time)
                : world_normal(interpolate(mesh_->normals, triangle, barycentrics));
    const float length = compute_length(n);
    return length > 0.0f ? n / length : Vec3(0.0f);
}

Vec4 PlacedMesh::tangent(std::uint32_t triangle, Vec2 barycentrics, int uv_set, float time) const
{
    if (!mesh_->tangents.empty()) {
        const Vec4 t = moves() ? interpolate(mesh_->tangents, &MeshPose::tangents, triangle,
                                             barycentrics, time)
                               : interpolate(mesh_->tangents, triangle, barycentrics);
        const Vec3 along = moves() ? placement(time).linear * Vec3(t) : world_vector(Vec3(t));
        return {along, std::copysign(front_sign(), front_sign() * t.w)};
    }
    const auto& uvs = mesh_->uvs[static_cast<std::size_t>(uv_set)];
    if (uvs.empty()) {
        return Vec4(0.0f);
    }
    const UVec3& i = mesh_->triangles[triangle];
    const auto [a, b, c] = corners(triangle, time);
    const Vec2 d1 = uvs[i.y] - uvs[i.x];
    const Vec2 d2 = uvs[i.z] - uvs[i.x];
    const float area = d1.x * d2.y - d1.y * d2.x;  // signed area of the triangle in the texture
    if (area == 0.0f) {
        return Vec4(0.0f);
    }
    const Vec3 along_u = std::copysign(1.0f, area) * (d2.y * (b - a) - d1.y * (c - a));
    // v grows downwards in glTF and the bitangent points up in the image. A triangle that is not
    // mirrored in the texture has clockwise vertices there, so the area is negative.
    return {along_u, -std::copysign(front_sign(), area * front_sign())};
}

Vec4 PlacedMesh::color(std::uint32_t triangle, Vec2 barycentrics) const
{
    return mesh_->colors.empty() ? Vec4(1.0f) : interpolate(mesh_->colors, triangle, barycentrics);
}

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
