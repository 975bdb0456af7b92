#pragma once

#include "geometry/embree_scene.h"
#include "geometry/placed_mesh.h"
#include "geometry/sphere.h"
#include "light/light_samples.h"
#include "scene/contacts/contacts.h"

#include <bdpt/scene.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace bdpt {

/// The bounds of a mesh in its own space.
struct MeshBox {
    Vec3 center{0.0f};
    Vec3 half{0.0f};
};

/// Everything that rays hit: placed meshes and spheres, without materials. An edited scene shares
/// it with the original scene if it is unchanged.
struct SceneGeometry {
    /// Constructs the geometry of a valid description, without BVHs. What meshes have in common
    /// with those of `like` is not computed again.
    explicit SceneGeometry(const SharedSceneDesc& desc, const SceneGeometry* like = nullptr);
    SceneGeometry(const SceneGeometry&) = delete;
    SceneGeometry& operator=(const SceneGeometry&) = delete;

    /// Tests whether the geometry of `desc` would be the same, apart from BVHs.
    [[nodiscard]] bool fits(const SharedSceneDesc& desc) const;
    /// Tests whether the materials of `desc` move the same faces where things touch.
    [[nodiscard]] bool same_contacts(const SharedSceneDesc& desc) const;
    /// Returns the number of meshes that instances in `traced` refer to.
    [[nodiscard]] std::size_t traced_meshes() const { return meshes.size() + contacts.open.size(); }
    /// Builds the BVHs, and reuses those of unchanged meshes from `like`.
    void build(const AnyHitFilter& filter, Isa isa, const SceneGeometry* like);

    // Data that the other members refer to.
    SharedList<MeshDesc> meshes;
    SharedList<InstanceDesc> instances;
    /// The instances as BVHs have them: those with an open mesh have one beyond all others.
    SharedList<InstanceDesc> traced;
    SharedList<LightDesc> lights;
    SharedList<VolumeDesc> volumes;
    ContactKind contact_kind;        ///< of the description
    std::vector<ContactPart> parts;  // one per instance
    ShellTable shells;               // of meshes that bound bodies, or shine
    Contacts contacts;

    std::vector<PlacedMesh> placed;  // one per instance
    std::vector<Sphere> spheres;
    std::vector<std::optional<MeshBox>> boxes;  // one per mesh; nullopt without triangles
    Bounds bounds;
    BoundingSphere sphere;
    SceneCounts counts;  // excluding lights
    std::optional<EmbreeScene> trees;
};

}  // namespace bdpt
