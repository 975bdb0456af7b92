#include "gltf/geometry/mesh.h"

#include <bdpt/error.h>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "file/read_file.h"
#include "gltf/document/document.h"

namespace bdpt::io {

PrimitiveReader::PrimitiveReader(const tinygltf::Model& model, PrimitiveId id)
    : model_(&model),
      source_(&model.meshes[id.mesh].primitives[id.primitive]),
      id_(id),
      name_(model.meshes[id.mesh].name)
{}

void PrimitiveReader::fail(std::string_view where, const std::string& what) const
{
    throw Error(ErrorCode::invalid_input, fmt::format("{}/{}: {}{}{}", id_.pointer(), where,
                                                      name_.empty() ? "" : "mesh " + quote(name_),
                                                      name_.empty() ? "" : ": ", what));
}

std::optional<int> PrimitiveReader::find(const Attributes& attributes, const std::string& semantic)
{
    const auto found = attributes.find(semantic);
    return found == attributes.end() ? std::nullopt : std::optional(found->second);
}

namespace {

void check_finite(const PrimitiveReader& primitive, const std::vector<Vec3>& positions)
{
    for (std::size_t i = 0; i < positions.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            if (!std::isfinite(positions[i][c])) {
                primitive.fail("attributes/POSITION",
                               fmt::format("vertex {}: {} is {}", i, "xyz"[c], positions[i][c]));
            }
        }
    }
}

std::vector<std::uint32_t> read_checked_indices(const PrimitiveReader& primitive,
                                                std::size_t vertices)
{
    const int accessor = primitive.source().indices;
    if (accessor < 0) {
        std::vector<std::uint32_t> indices(vertices);
        std::iota(indices.begin(), indices.end(), 0u);
        return indices;
    }
    std::vector<std::uint32_t> indices = read_indices(primitive.model(), accessor);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (indices[i] >= vertices) {
            primitive.fail("indices",
                           fmt::format("element {} is {}, but the number of vertices is {}", i,
                                       indices[i], vertices));
        }
    }
    return indices;
}

/// Reads COLOR_0, which has three or four components; integers are fractions, whether marked as
/// normalized or not.
std::vector<Vec4> read_colors(const PrimitiveReader& primitive, std::size_t vertices,
                              LoadContext& context)
{
    const std::string semantic = "COLOR_0";
    const std::optional<int> accessor = primitive.attribute(semantic);
    if (!accessor) {
        return {};
    }
    const auto& described = primitive.model().accessors[static_cast<std::size_t>(*accessor)];
    if (described.type == TINYGLTF_TYPE_VEC4) {
        return primitive.read<Vec4>(semantic, vertices, context, Integers::normalized);
    }
    const std::vector<Vec3> rgb =
        primitive.read<Vec3>(semantic, vertices, context, Integers::normalized);
    std::vector<Vec4> colors;
    colors.reserve(rgb.size());
    for (const Vec3& color : rgb) {
        colors.emplace_back(color, 1.0f);
    }
    return colors;
}

/// Charges the memory of indices and all attributes, morph targets included.
void spend(const PrimitiveReader& primitive, LoadContext& context)
{
    constexpr std::uint64_t element_bytes = sizeof(Vec4);
    const auto spend_one = [&](int accessor) {
        const auto& described = primitive.model().accessors[static_cast<std::size_t>(accessor)];
        context.budget.spend(primitive.id().pointer(), described.count, element_bytes);
    };
    const auto spend_all = [&](const std::map<std::string, int>& attributes) {
        for (const auto& [semantic, accessor] : attributes) {
            spend_one(accessor);
        }
    };
    if (primitive.source().indices >= 0) {
        spend_one(primitive.source().indices);
    }
    spend_all(primitive.source().attributes);
    for (const auto& target : primitive.source().targets) {
        spend_all(target);
    }
}

/// Warns of triangles without area. They are kept, since tracing ignores them, but often indicate a
/// defect of the model.
void warn_of_no_area(const MeshDesc& mesh, PrimitiveId id, LoadContext& context)
{
    const auto flat =
        std::count_if(mesh.triangles.begin(), mesh.triangles.end(), [&mesh](const UVec3& triangle) {
            const Vec3& a = mesh.positions[triangle.x];
            return glm::cross(mesh.positions[triangle.y] - a, mesh.positions[triangle.z] - a) ==
                   Vec3(0.0f);
        });
    if (flat > 0) {
        context.warn("triangles without area are not rendered",
                     fmt::format("{}: {} of {}", id.pointer(), flat, mesh.triangles.size()));
    }
}

}  // namespace

std::string PrimitiveId::pointer() const
{
    return fmt::format("/meshes/{}/primitives/{}", mesh, primitive);
}

std::vector<UVec3> to_triangles(const std::vector<std::uint32_t>& indices, int mode)
{
    std::vector<UVec3> triangles;
    const std::size_t n = indices.size();
    if (n < 3) {
        return triangles;
    }
    if (mode == TINYGLTF_MODE_TRIANGLES) {
        triangles.reserve(n / 3);
        for (std::size_t i = 0; i + 2 < n; i += 3) {
            triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
        }
    } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
        triangles.reserve(n - 2);
        for (std::size_t i = 0; i + 2 < n; ++i) {
            // Every second triangle is flipped, so that all have the same orientation.
            triangles.emplace_back(indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]);
        }
    } else if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
        triangles.reserve(n - 2);
        for (std::size_t i = 0; i + 2 < n; ++i) {
            triangles.emplace_back(indices[i + 1], indices[i + 2], indices[0]);
        }
    }
    return triangles;
}

std::optional<MeshDesc> read_primitive(const tinygltf::Model& model, PrimitiveId id,
                                       const Deformation& deformation, LoadContext& context)
{
    const PrimitiveReader primitive(model, id);
    const int mode = primitive.source().mode;
    if (mode < TINYGLTF_MODE_POINTS || mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        primitive.fail("mode", fmt::format("{} is not a primitive mode", mode));
    }
    if (mode < TINYGLTF_MODE_TRIANGLES) {
        context.warn(WarningKind::loss, "points and lines are not rendered",
                     fmt::format("{}: mode {}", id.pointer(), mode));
        return std::nullopt;
    }
    const std::optional<int> position_accessor = primitive.attribute("POSITION");
    if (!position_accessor) {
        context.warn("primitive without POSITION is not rendered", id.pointer());
        return std::nullopt;
    }
    spend(primitive, context);

    MeshDesc desc;
    desc.name = model.meshes[id.mesh].name;
    desc.positions = read_vectors<Vec3>(model, *position_accessor);
    check_finite(primitive, desc.positions);
    const std::size_t vertices = desc.positions.size();
    const std::vector<std::uint32_t> indices = read_checked_indices(primitive, vertices);
    desc.triangles = to_triangles(indices, mode);
    if (desc.triangles.empty() || (mode == TINYGLTF_MODE_TRIANGLES && indices.size() % 3 != 0)) {
        context.warn("the number of indices does not make whole triangles",
                     fmt::format("{}: {}", id.pointer(), indices.size()));
    }
    if (desc.triangles.empty()) {
        return std::nullopt;
    }
    desc.normals = primitive.read<Vec3>("NORMAL", vertices, context);
    desc.tangents = primitive.read<Vec4>("TANGENT", vertices, context);
    desc.uvs[0] = primitive.read<Vec2>("TEXCOORD_0", vertices, context);
    desc.uvs[1] = primitive.read<Vec2>("TEXCOORD_1", vertices, context);
    desc.colors = read_colors(primitive, vertices, context);
    apply_morph(desc, primitive, deformation.weights, context);
    apply_skin(desc, primitive, deformation.joints, context);
    check_finite(primitive, desc.positions);
    repair_attributes(desc, id.pointer(), context);
    warn_of_no_area(desc, id, context);
    return desc;
}

}  // namespace bdpt::io
