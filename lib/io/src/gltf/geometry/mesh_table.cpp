#include "gltf/geometry/mesh_table.h"

#include "file/load_context.h"
#include "gltf/geometry/mesh.h"

#include <bdpt/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace bdpt::io {

namespace {

/// Returns the weights of the targets of `primitive`, without zeros at the end: the node's own,
/// else the mesh's [glTF 2.0, sec. 3.7.2.2].
std::vector<double> morph_weights(const std::vector<double>& of_node, const tinygltf::Mesh& mesh,
                                  const tinygltf::Primitive& primitive)
{
    std::vector<double> weights = of_node.empty() ? mesh.weights : of_node;
    weights.resize(std::min(weights.size(), primitive.targets.size()));
    while (!weights.empty() && weights.back() == 0.0) {
        weights.pop_back();
    }
    return weights;
}

/// Drops normals and tangents that are missing in some pose, where they could not be repaired.
void drop_what_some_pose_lacks(MeshDesc& mesh)
{
    const auto drop = [&mesh](auto& first, auto later) {
        const bool lacks =
            std::any_of(mesh.motion.begin(), mesh.motion.end(),
                        [&](const MeshPose& pose) { return (pose.*later).size() != first.size(); });
        if (lacks) {
            first.clear();
            for (MeshPose& pose : mesh.motion) {
                (pose.*later).clear();
            }
        }
    };
    drop(mesh.normals, &MeshPose::normals);
    drop(mesh.tangents, &MeshPose::tangents);
}

}  // namespace

const MeshTable::Joints& MeshTable::joints(int skin)
{
    const auto [found, is_new] = joints_.try_emplace(skin);
    if (is_new) {
        const tinygltf::Skin& source = model_.skins[static_cast<std::size_t>(skin)];
        if (source.joints.empty()) {
            throw Error(ErrorCode::invalid_input,
                        fmt::format("/skins/{}/joints: a skin needs at least one", skin));
        }
        const std::size_t steps = moves(source, motion_) ? motion_.steps() : 0;
        for (std::size_t step = 0; step <= steps; ++step) {
            found->second.push_back(
                joint_matrices(model_, skin, transforms_, motion_, step, context_));
        }
    }
    return found->second;
}

MeshId MeshTable::add(MeshDesc mesh, PrimitiveId id)
{
    triangles_ += mesh.triangles.size();
    if (triangles_ > context_.limits.triangles) {
        throw Error(ErrorCode::invalid_input, fmt::format("{}: more than {} triangles",
                                                          id.pointer(), context_.limits.triangles));
    }
    context_.budget.memory().spend(id.pointer(), mesh.triangles.size() * traced_triangle);
    meshes_.push_back(std::move(mesh));
    return static_cast<MeshId>(meshes_.size() - 1);
}

std::optional<MeshDesc> MeshTable::read(PrimitiveId id, const std::vector<Weights>& weights,
                                        const Joints& joints)
{
    const auto deformation = [&](std::size_t step) {
        const auto joints_then =
            joints.empty() ? std::span<const glm::dmat4>() : joints[joints.size() > 1 ? step : 0];
        return Deformation{weights[weights.size() > 1 ? step : 0], joints_then};
    };
    std::optional<MeshDesc> mesh = read_primitive(model_, id, deformation(0), context_);
    const bool deforms = weights.size() > 1 || joints.size() > 1;
    for (std::size_t step = 1; mesh && deforms && step <= motion_.steps(); ++step) {
        const Silence silence(context_.warnings);  // The first pose has given all warnings.
        std::optional<MeshDesc> later = read_primitive(model_, id, deformation(step), context_);
        mesh->motion.push_back(
            {std::move(later->positions), std::move(later->normals), std::move(later->tangents)});
    }
    if (mesh) {
        drop_what_some_pose_lacks(*mesh);
    }
    return mesh;
}

std::optional<ShownMesh> MeshTable::get(std::size_t node, std::size_t primitive)
{
    const tinygltf::Node& source = model_.nodes[node];
    const PrimitiveId id{static_cast<std::size_t>(source.mesh), primitive};
    const tinygltf::Mesh& mesh = model_.meshes[id.mesh];
    int skin = source.skin;
    if (skin >= 0 && !has_joints(PrimitiveReader(model_, id))) {
        context_.warn("a mesh without JOINTS_0 and WEIGHTS_0 does not follow its skin",
                      id.pointer());
        skin = -1;
    }
    const bool skinned = skin >= 0;
    std::vector<Weights> weights;
    for (const Weights& of_node : motion_.weights(node)) {
        weights.push_back(morph_weights(of_node, mesh, mesh.primitives[primitive]));
    }
    if (weights.empty() || std::equal(weights.begin() + 1, weights.end(), weights.begin())) {
        weights = {morph_weights(source.weights, mesh, mesh.primitives[primitive])};
    }
    const auto [found, is_new] = known_.try_emplace(Key{id.mesh, primitive, skin, weights});
    if (is_new) {
        if (std::optional<MeshDesc> desc = read(id, weights, skinned ? joints(skin) : Joints())) {
            const bool recenters = storage_ == Storage::recentered && !skinned;
            const DVec3 center = recenters ? recenter(*desc) : DVec3(0.0);
            found->second = ShownMesh{add(std::move(*desc), id), skinned, center};
        }
    }
    return found->second;
}

std::optional<MeshId> MeshTable::flatten(MeshId mesh, PrimitiveId id,
                                         std::span<const glm::dmat4> world_from_object)
{
    const MeshDesc& source = meshes_[static_cast<std::size_t>(mesh)];
    context_.budget.spend(
        id.pointer(), source.positions.size() * world_from_object.size() + source.triangles.size(),
        sizeof(Vec4));
    std::optional<MeshDesc> flat = place_mesh(source, world_from_object);
    return flat ? std::optional(add(std::move(*flat), id)) : std::nullopt;
}

}  // namespace bdpt::io
