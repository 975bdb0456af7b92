#pragma once

#include <bdpt/scene_desc.h>
#include <glm/mat4x4.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

#include "file/load_context.h"
#include "gltf/animation/node_transforms.h"
#include "gltf/document/document.h"
#include "gltf/geometry/mesh.h"

namespace bdpt::io {

/// Applies a transform without an inverse, which no instance can have, to the positions of a mesh;
/// or several, one per time, which makes the mesh deform: as many as the steps of a mesh that
/// already deforms. The result has face normals. Returns none if no triangle ever has an area.
[[nodiscard]] std::optional<MeshDesc> place_mesh(const MeshDesc& mesh,
                                                 std::span<const glm::dmat4> world_from_object);

/// Returns the origin that a world needs whose coordinates are far larger than it, as on a map: its
/// centre, along those axes where it lies far away. All bits of the coordinates remain when it is
/// subtracted. None: an ordinary scene. It is zero if only the meshes have such coordinates, which
/// their instances undo.
[[nodiscard]] std::optional<DVec3> distant_origin(const SceneDesc& scene);

/// Subtracts the centre of a mesh from its positions, along those axes where it lies far away;
/// returns what was subtracted, which its instances must add.
[[nodiscard]] DVec3 recenter(MeshDesc& mesh);

/// A mesh of a node.
struct ShownMesh {
    MeshId mesh{};
    bool in_world = false;  ///< skinned: already in world space, so no node transform applies
    DVec3 center{0.0};      ///< was subtracted from its positions; else zero
};

/// Reads primitives, and each deformation of a primitive only once.
class MeshTable {
public:
    /// How meshes are stored that lie far from the origin of their space.
    enum class Storage : std::uint8_t { as_in_file, recentered };

    /// The arguments must outlive the table. Meshes are added to `meshes`.
    MeshTable(const tinygltf::Model& model, NodeTransforms& transforms, const NodeMotion& motion,
              std::vector<MeshDesc>& meshes, Storage storage, LoadContext& context)
        : model_(model),
          transforms_(transforms),
          motion_(motion),
          meshes_(meshes),
          storage_(storage),
          context_(context)
    {}

    /// Returns primitive `primitive` of the node's mesh, with the node's skin and weights of morph
    /// targets; none if it has no triangles. If these move, the mesh has a motion of as many steps
    /// as the nodes. Throws `Error` (invalid_input).
    [[nodiscard]] std::optional<ShownMesh> get(std::size_t node, std::size_t primitive);

    /// Returns a mesh in world space, for transforms without an inverse; one transform per time, or
    /// one for all. None if nothing visible is left. Throws `Error` (invalid_input) over the
    /// limits.
    [[nodiscard]] std::optional<MeshId> flatten(MeshId mesh, PrimitiveId id,
                                                std::span<const glm::dmat4> world_from_object);

private:
    using Weights = std::vector<double>;
    /// Mesh, primitive, skin (-1: none), weights of morph targets at one time or at each.
    using Key = std::tuple<std::size_t, std::size_t, int, std::vector<Weights>>;
    /// Matrices of a skin at one time or at each.
    using Joints = std::vector<std::vector<glm::dmat4>>;

    [[nodiscard]] MeshId add(MeshDesc mesh, PrimitiveId id);
    [[nodiscard]] const Joints& joints(int skin);
    /// Reads a primitive. `weights` and `joints` are for one time or for each; no joints: no skin.
    [[nodiscard]] std::optional<MeshDesc> read(PrimitiveId id, const std::vector<Weights>& weights,
                                               const Joints& joints);

    const tinygltf::Model& model_;
    NodeTransforms& transforms_;
    const NodeMotion& motion_;
    std::vector<MeshDesc>& meshes_;
    Storage storage_;
    LoadContext& context_;
    std::map<Key, std::optional<ShownMesh>> known_;
    std::map<int, Joints> joints_;  // by skin
    std::uint64_t triangles_ = 0;
};

}  // namespace bdpt::io
