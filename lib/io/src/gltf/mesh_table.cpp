#include "gltf/mesh_table.h"

#include "gltf/placement.h"
#include "gltf/primitive_reader.h"
#include "gltf/skin.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace bdpt::io {

namespace {

/// Weights of the targets of `primitive`, without zeros at the end: the node's own, else the mesh's
/// [glTF 2.0, sec. 3.7.2.2].
std::vector<double> morph_weights(const tinygltf::Node& node, const tinygltf::Mesh& mesh,
                                  const tinygltf::Primitive& primitive)
{
    std::vector<double> weights = node.weights.empty() ? mesh.weights : node.weights;
    weights.resize(std::min(weights.size(), primitive.targets.size()));
    while (!weights.empty() && weights.back() == 0.0) {
        weights.pop_back();
    }
    return weights;
}

}  // namespace

const std::vector<glm::dmat4>& MeshTable::joints(int skin)
{
    const auto [found, is_new] = joints_.try_emplace(skin);
    if (is_new) {
        const JsonPlace root(model_.motion);
        const JsonPlace skins = root.member("skins");
        const JsonPlace place = skins.element(static_cast<std::size_t>(skin));
        if (place.member("joints").size() == 0) {
            place.member("joints").fail("a skin needs at least one");
        }
        found->second = joint_matrices(model_.structs, place, transforms_, budget_);
    }
    return found->second;
}

MeshId MeshTable::add(MeshDesc mesh, PrimitiveId id)
{
    triangles_ += mesh.triangles.size();
    if (triangles_ > limits_.triangles) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("{}: more than {} triangles", id.pointer(), limits_.triangles));
    }
    // Copies of the corners and the tree over them, by Embree (benchmarks/load_memory.py).
    constexpr std::uint64_t traced_triangle = 100;  // [bytes]
    try {
        budget_.spend_memory(mesh.triangles.size() * traced_triangle);
    } catch (const Error& error) {
        throw Error(error.code(), id.pointer() + ": " + error.what());
    }
    meshes_.push_back(std::move(mesh));
    return static_cast<MeshId>(meshes_.size() - 1);
}

std::optional<ShownMesh> MeshTable::get(std::size_t node, std::size_t primitive)
{
    const tinygltf::Node& source = model_.structs.nodes[node];
    const PrimitiveId id{static_cast<std::size_t>(source.mesh), primitive};
    const tinygltf::Mesh& mesh = model_.structs.meshes[id.mesh];
    int skin = source.skin;
    if (skin >= 0 && !has_joints(PrimitiveReader(model_.structs, id))) {
        warnings_.add("a mesh without JOINTS_0 and WEIGHTS_0 does not follow its skin",
                      id.pointer());
        skin = -1;
    }
    const bool skinned = skin >= 0;
    std::vector<double> weights = morph_weights(source, mesh, mesh.primitives[primitive]);
    const auto [found, is_new] = known_.try_emplace(Key{id.mesh, primitive, skin, weights});
    if (is_new) {
        const Deformation deformation{
            std::move(weights),
            skinned ? std::span<const glm::dmat4>(joints(skin)) : std::span<const glm::dmat4>()};
        if (std::optional<MeshDesc> read =
                read_primitive(model_.structs, id, deformation, budget_, warnings_)) {
            found->second = add(std::move(*read), id);
        }
    }
    return found->second ? std::optional(ShownMesh{*found->second, skinned}) : std::nullopt;
}

std::optional<MeshId> MeshTable::flatten(MeshId mesh, PrimitiveId id,
                                         const glm::dmat4& world_from_object)
{
    const MeshDesc& source = meshes_[static_cast<std::size_t>(mesh)];
    budget_.spend(id.pointer(), source.positions.size() + source.triangles.size(), sizeof(Vec4));
    std::optional<MeshDesc> flat = place_mesh(source, world_from_object);
    return flat ? std::optional(add(std::move(*flat), id)) : std::nullopt;
}

}  // namespace bdpt::io
