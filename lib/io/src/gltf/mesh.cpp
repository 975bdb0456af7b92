#include "gltf/mesh.h"

#include "file/uri.h"
#include "gltf/accessor.h"
#include "gltf/attributes.h"
#include "gltf/model.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numeric>
#include <string_view>
#include <utility>

namespace bdpt::io {

namespace {

struct Primitive {
    const tinygltf::Model& model;
    const tinygltf::Primitive& source;
    PrimitiveId id;
    std::string name;  // of the mesh

    [[noreturn]] void fail(std::string_view where, const std::string& what) const
    {
        throw Error(ErrorCode::invalid_input, fmt::format("{}/{}: {}{}{}", id.pointer(), where,
                                                          name.empty() ? "" : "mesh " + quote(name),
                                                          name.empty() ? "" : ": ", what));
    }

    /// The attribute's accessor if it is there.
    [[nodiscard]] std::optional<int> attribute(const std::string& semantic) const
    {
        const auto found = source.attributes.find(semantic);
        if (found == source.attributes.end()) {
            return std::nullopt;
        }
        return found->second;
    }

    /// As many values as there are vertices; none if the attribute is not there.
    template <typename V>
    [[nodiscard]] std::vector<V> read(const std::string& semantic, std::size_t vertices,
                                      Warnings& warnings,
                                      Integers integers = Integers::as_declared) const
    {
        const std::optional<int> accessor = attribute(semantic);
        if (!accessor) {
            return {};
        }
        std::vector<V> values = read_vectors<V>(model, *accessor, integers);
        if (values.size() < vertices) {
            fail("attributes/" + semantic,
                 fmt::format("{} values, but there are {} vertices", values.size(), vertices));
        }
        if (values.size() > vertices) {
            warnings.add("more values than vertices; the rest is ignored",
                         id.pointer() + "/attributes/" + semantic);
            values.resize(vertices);
        }
        return values;
    }
};

std::vector<Vec3> read_positions(const Primitive& primitive, int accessor)
{
    std::vector<Vec3> positions = read_vectors<Vec3>(primitive.model, accessor);
    for (std::size_t i = 0; i < positions.size(); ++i) {
        for (int c = 0; c < 3; ++c) {
            if (!std::isfinite(positions[i][c])) {
                primitive.fail("attributes/POSITION",
                               fmt::format("vertex {}: {} is {}", i, "xyz"[c], positions[i][c]));
            }
        }
    }
    return positions;
}

std::vector<std::uint32_t> read_checked_indices(const Primitive& primitive, std::size_t vertices)
{
    const std::optional<int> accessor = primitive.attribute(indices_attribute);
    if (!accessor) {
        std::vector<std::uint32_t> indices(vertices);
        std::iota(indices.begin(), indices.end(), 0u);
        return indices;
    }
    std::vector<std::uint32_t> indices = read_indices(primitive.model, *accessor);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        if (indices[i] >= vertices) {
            primitive.fail("indices", fmt::format("element {} is {}, but there are {} vertices", i,
                                                  indices[i], vertices));
        }
    }
    return indices;
}

/// COLOR_0 has three or four components; integers are fractions, whether they say so or not.
std::vector<Vec4> read_colors(const Primitive& primitive, std::size_t vertices, Warnings& warnings)
{
    const std::string semantic = "COLOR_0";
    const std::optional<int> accessor = primitive.attribute(semantic);
    if (!accessor) {
        return {};
    }
    const auto& described = primitive.model.accessors[static_cast<std::size_t>(*accessor)];
    if (described.type == TINYGLTF_TYPE_VEC4) {
        return primitive.read<Vec4>(semantic, vertices, warnings, Integers::normalized);
    }
    const std::vector<Vec3> rgb =
        primitive.read<Vec3>(semantic, vertices, warnings, Integers::normalized);
    std::vector<Vec4> colors;
    colors.reserve(rgb.size());
    for (const Vec3& color : rgb) {
        colors.emplace_back(color, 1.0f);
    }
    return colors;
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
            // Every second triangle is turned over, so that all face the same way.
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
                                       Warnings& warnings)
{
    const tinygltf::Mesh& mesh = model.meshes[id.mesh];
    const Primitive primitive{model, mesh.primitives[id.primitive], id, mesh.name};
    const int mode = primitive.source.mode;
    if (mode < TINYGLTF_MODE_POINTS || mode > TINYGLTF_MODE_TRIANGLE_FAN) {
        primitive.fail("mode", fmt::format("{} is no mode", mode));
    }
    if (mode < TINYGLTF_MODE_TRIANGLES) {
        warnings.add("points and lines are not rendered",
                     fmt::format("{}: mode {}", id.pointer(), mode));
        return std::nullopt;
    }
    const std::optional<int> position_accessor = primitive.attribute("POSITION");
    if (!position_accessor) {
        warnings.add("primitive without POSITION is not rendered", id.pointer());
        return std::nullopt;
    }

    MeshDesc desc;
    desc.name = mesh.name;
    desc.positions = read_positions(primitive, *position_accessor);
    const std::size_t vertices = desc.positions.size();
    const std::vector<std::uint32_t> indices = read_checked_indices(primitive, vertices);
    desc.triangles = to_triangles(indices, mode);
    if (desc.triangles.empty() || (mode == TINYGLTF_MODE_TRIANGLES && indices.size() % 3 != 0)) {
        warnings.add("the number of indices does not make whole triangles",
                     fmt::format("{}: {}", id.pointer(), indices.size()));
    }
    if (desc.triangles.empty()) {
        return std::nullopt;
    }
    desc.normals = primitive.read<Vec3>("NORMAL", vertices, warnings);
    desc.tangents = primitive.read<Vec4>("TANGENT", vertices, warnings);
    desc.uvs[0] = primitive.read<Vec2>("TEXCOORD_0", vertices, warnings);
    desc.uvs[1] = primitive.read<Vec2>("TEXCOORD_1", vertices, warnings);
    desc.colors = read_colors(primitive, vertices, warnings);
    repair_attributes(desc, id.pointer(), warnings);
    return desc;
}

}  // namespace bdpt::io
