#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "gltf/geometry/mesh.h"

namespace bdpt::io {

namespace {

// Squared length below which a direction is noise: quantised unit vectors are far above.
constexpr float min_length_squared = 1e-12f;

/// Normalizes a vector, if possible. In double, so that huge and tiny ones survive the square.
std::optional<Vec3> unit(Vec3 v)
{
    const glm::dvec3 wide(v);
    const double squared = glm::dot(wide, wide);
    if (!(squared > static_cast<double>(min_length_squared)) || !std::isfinite(squared)) {
        return std::nullopt;
    }
    return Vec3(wide / std::sqrt(squared));
}

glm::dvec3 area_normal(const MeshDesc& mesh, const UVec3& triangle)
{
    const glm::dvec3 a(mesh.positions[triangle.x]);
    const glm::dvec3 b(mesh.positions[triangle.y]);
    const glm::dvec3 c(mesh.positions[triangle.z]);
    return glm::cross(b - a, c - a);
}

/// Gives vertices without a usable normal the mean normal of their triangles, weighted by area.
void replace_normals(MeshDesc& mesh, const std::vector<bool>& broken)
{
    std::vector<glm::dvec3> sums(mesh.normals.size(), glm::dvec3(0.0));
    for (const UVec3& triangle : mesh.triangles) {
        const glm::dvec3 normal = area_normal(mesh, triangle);
        for (int corner = 0; corner < 3; ++corner) {
            sums[triangle[corner]] += normal;
        }
    }
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        if (!broken[i]) {
            continue;
        }
        const double length = glm::length(sums[i]);
        // A vertex of triangles without area is never hit: any direction serves.
        mesh.normals[i] =
            length > 0.0 && std::isfinite(length) ? Vec3(sums[i] / length) : Vec3(0, 0, 1);
    }
}

void repair_normals(MeshDesc& mesh, const std::string& place, LoadContext& context)
{
    std::vector<bool> broken(mesh.normals.size(), false);
    bool any_broken = false;
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        const std::optional<Vec3> normal = unit(mesh.normals[i]);
        if (normal) {
            mesh.normals[i] = *normal;
        } else {
            broken[i] = true;
            any_broken = true;
        }
    }
    if (any_broken) {
        context.warn("zero or invalid normals are replaced by those of the faces",
                     place + "/attributes/NORMAL");
        replace_normals(mesh, broken);
    }
}

void repair_tangents(MeshDesc& mesh, const std::string& place, LoadContext& context)
{
    if (mesh.normals.empty()) {
        mesh.tangents.clear();  // Tangents mean nothing without normals [glTF 2.0, sec. 3.7.2.1].
        return;
    }
    for (Vec4& tangent : mesh.tangents) {
        const std::optional<Vec3> direction = unit(Vec3(tangent));
        if (!direction || std::isnan(tangent.w)) {
            context.warn("zero or invalid tangents: all are derived from TEXCOORD_0",
                         place + "/attributes/TANGENT");
            mesh.tangents.clear();
            return;
        }
        tangent = Vec4(*direction, tangent.w < 0.0f ? -1.0f : 1.0f);
    }
}

void repair_uvs(std::vector<Vec2>& uvs, const std::string& place, LoadContext& context)
{
    for (Vec2& uv : uvs) {
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) {
            context.warn("texture coordinates that are not finite are treated as 0", place);
            uv = Vec2(0.0f);
        }
    }
}

void repair_colors(MeshDesc& mesh, const std::string& place, LoadContext& context)
{
    for (Vec4& color : mesh.colors) {
        for (int c = 0; c < 4; ++c) {
            if (!(color[c] >= 0.0f && color[c] <= 1.0f)) {
                context.warn("vertex colours beyond [0, 1] are clamped",
                             place + "/attributes/COLOR_0");
                color[c] = color[c] > 1.0f ? 1.0f : 0.0f;
            }
        }
    }
}

}  // namespace

void repair_attributes(MeshDesc& mesh, const std::string& place, LoadContext& context)
{
    repair_normals(mesh, place, context);
    repair_tangents(mesh, place, context);
    repair_uvs(mesh.uvs[0], place + "/attributes/TEXCOORD_0", context);
    repair_uvs(mesh.uvs[1], place + "/attributes/TEXCOORD_1", context);
    repair_colors(mesh, place, context);
}

namespace {

/// Adds weight * displacements to the values. Displacements are empty if the target does not move
/// the attribute.
template <typename V>
void add(std::vector<V>& values, const std::vector<V>& displacements, float weight)
{
    for (std::size_t i = 0; i < displacements.size(); ++i) {
        values[i] += weight * displacements[i];
    }
}

}  // namespace

void apply_morph(MeshDesc& mesh, const PrimitiveReader& primitive, std::span<const double> weights,
                 LoadContext& context)
{
    const std::size_t targets = std::min(weights.size(), primitive.source().targets.size());
    const std::size_t vertices = mesh.positions.size();
    for (std::size_t t = 0; t < targets; ++t) {
        const auto weight = static_cast<float>(weights[t]);
        if (weight == 0.0f) {
            continue;
        }
        const auto read = [&]<typename V>(const char* semantic, V) {
            return primitive.read_target<V>(t, semantic, vertices, context);
        };
        add(mesh.positions, read("POSITION", Vec3()), weight);
        // A target cannot move attributes that the mesh itself does not have.
        if (!mesh.normals.empty()) {
            add(mesh.normals, read("NORMAL", Vec3()), weight);
        }
        if (!mesh.tangents.empty()) {
            const std::vector<Vec3> moved = read("TANGENT", Vec3());
            for (std::size_t i = 0; i < moved.size(); ++i) {
                mesh.tangents[i] += Vec4(weight * moved[i], 0.0f);  // the handedness is kept
            }
        }
        constexpr const char* coordinates[] = {"TEXCOORD_0", "TEXCOORD_1"};
        for (std::size_t set = 0; set < mesh.uvs.size(); ++set) {
            if (!mesh.uvs[set].empty()) {
                add(mesh.uvs[set], read(coordinates[set], Vec2()), weight);
            }
        }
        if (!mesh.colors.empty() && primitive.source().targets[t].contains("COLOR_0")) {
            const int accessor = primitive.source().targets[t].at("COLOR_0");
            const bool rgba =
                primitive.model().accessors[static_cast<std::size_t>(accessor)].type ==
                TINYGLTF_TYPE_VEC4;
            if (rgba) {
                add(mesh.colors, read("COLOR_0", Vec4()), weight);
            } else {
                const std::vector<Vec3> moved = read("COLOR_0", Vec3());
                for (std::size_t i = 0; i < moved.size(); ++i) {
                    mesh.colors[i] += Vec4(weight * moved[i], 0.0f);
                }
            }
        }
    }
}

}  // namespace bdpt::io
