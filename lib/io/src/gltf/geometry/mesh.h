#pragma once

#include <bdpt/scene_desc.h>
#include <fmt/format.h>
#include <tiny_gltf.h>
#include <glm/mat4x4.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "file/load_context.h"
#include "gltf/animation/node_transforms.h"
#include "gltf/document/document.h"

namespace bdpt::io {

/// One primitive of a glTF mesh, by indices.
struct PrimitiveId {
    std::size_t mesh = 0;
    std::size_t primitive = 0;

    [[nodiscard]] std::string pointer() const;
};

/// Deformation of a mesh before it is placed.
struct Deformation {
    std::vector<double> weights;           ///< weights of the morph targets; the rest are 0
    std::span<const glm::dmat4> joints{};  ///< world from bind pose; empty: no skin
};

/// Reads the triangles of a primitive; returns none if it has none, with a warning. With a skin
/// they are in world space, else in the node's space. Throws `Error` (invalid_input), for positions
/// that are not finite and indices out of range among others.
[[nodiscard]] std::optional<MeshDesc> read_primitive(const tinygltf::Model& model, PrimitiveId id,
                                                     const Deformation& deformation,
                                                     LoadContext& context);

/// Returns the triangles of indices of a strip, a fan or a list [glTF 2.0, sec. 3.7.2.1]; none for
/// modes without triangles. `mode` is that of glTF.
[[nodiscard]] std::vector<UVec3> to_triangles(const std::vector<std::uint32_t>& indices, int mode);

/// Reads attributes of one primitive and reports its errors.
class PrimitiveReader {
public:
    /// The model must outlive the reader.
    PrimitiveReader(const tinygltf::Model& model, PrimitiveId id);

    [[nodiscard]] const tinygltf::Primitive& source() const { return *source_; }
    [[nodiscard]] const tinygltf::Model& model() const { return *model_; }
    [[nodiscard]] PrimitiveId id() const { return id_; }

    /// Throws `Error` (invalid_input) that names the member `where` of the primitive, and the mesh.
    [[noreturn]] void fail(std::string_view where, const std::string& what) const;

    /// Returns the attribute's accessor, if any.
    [[nodiscard]] std::optional<int> attribute(const std::string& semantic) const
    {
        return find(source_->attributes, semantic);
    }

    /// Returns one value per vertex; empty if there is no such attribute.
    template <typename V>
    [[nodiscard]] std::vector<V> read(const std::string& semantic, std::size_t vertices,
                                      LoadContext& context,
                                      Integers integers = Integers::as_declared) const
    {
        return read_from<V>(source_->attributes, "attributes", semantic, vertices, context,
                            integers);
    }

    /// Reads an attribute likewise from the morph target `target`, which must exist.
    template <typename V>
    [[nodiscard]] std::vector<V> read_target(std::size_t target, const std::string& semantic,
                                             std::size_t vertices, LoadContext& context) const
    {
        return read_from<V>(source_->targets[target], fmt::format("targets/{}", target), semantic,
                            vertices, context, Integers::as_declared);
    }

private:
    using Attributes = std::map<std::string, int>;

    [[nodiscard]] static std::optional<int> find(const Attributes& attributes,
                                                 const std::string& semantic);

    template <typename V>
    [[nodiscard]] std::vector<V> read_from(const Attributes& attributes, const std::string& where,
                                           const std::string& semantic, std::size_t vertices,
                                           LoadContext& context, Integers integers) const
    {
        const std::optional<int> accessor = find(attributes, semantic);
        if (!accessor) {
            return {};
        }
        std::vector<V> values = read_vectors<V>(*model_, *accessor, integers);
        if (values.size() < vertices) {
            fail(where + "/" + semantic, fmt::format("{} values, but the number of vertices is {}",
                                                     values.size(), vertices));
        }
        if (values.size() > vertices) {
            context.warn("more values than vertices; the rest is ignored",
                         fmt::format("{}/{}/{}", id_.pointer(), where, semantic));
            values.resize(vertices);
        }
        return values;
    }

    const tinygltf::Model* model_;
    const tinygltf::Primitive* source_;
    PrimitiveId id_;
    std::string name_;  // name of the mesh
};

/// Repairs the attributes of a mesh to the requirements of `MeshDesc`: normals and tangents of unit
/// length, handedness +1 or -1, colours in [0, 1], everything finite. Positions and triangles must
/// be valid. Warns of changes that a correct file would not need; `place` is a JSON pointer.
void repair_attributes(MeshDesc& mesh, const std::string& place, LoadContext& context);

/// Adds the morph targets of a primitive, each times its weight, to positions, normals, tangents,
/// texture coordinates and colours [glTF 2.0, sec. 3.7.2.2]; targets beyond the weights have weight
/// 0. Normals and tangents are not normalized. Throws `Error` (invalid_input).
void apply_morph(MeshDesc& mesh, const PrimitiveReader& primitive, std::span<const double> weights,
                 LoadContext& context);

/// Returns world from bind pose for each joint of a skin, at a step of the motion: the joint's
/// world transform times its inverse bind matrix [glTF 2.0, sec. 3.7.3]. Throws `Error`
/// (invalid_input).
[[nodiscard]] std::vector<glm::dmat4> joint_matrices(const tinygltf::Model& model, int skin,
                                                     NodeTransforms& transforms,
                                                     const NodeMotion& motion, std::size_t step,
                                                     LoadContext& context);

/// Tests whether any joint of the skin moves.
[[nodiscard]] bool moves(const tinygltf::Skin& skin, const NodeMotion& motion);

/// Applies a skin to a mesh, which is in world space afterwards; all sets JOINTS_n and WEIGHTS_n
/// count. Weights are normalized to a sum of one. Parts that the joints mirror keep their front.
/// Does nothing without joints. Throws `Error` (invalid_input) for a joint that does not exist.
void apply_skin(MeshDesc& mesh, const PrimitiveReader& primitive,
                std::span<const glm::dmat4> joints, LoadContext& context);

/// Tests whether the primitive has the joint attributes of a skin.
[[nodiscard]] bool has_joints(const PrimitiveReader& primitive);

}  // namespace bdpt::io
