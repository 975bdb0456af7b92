#pragma once

#include "geometry/embree_scene.h"
#include "geometry/placed_mesh.h"
#include "geometry/sphere.h"
#include "light/bounding_sphere.h"

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

/// What rays meet: meshes and spheres at their places, whatever they are made of. An edited scene
/// shares it with the scene that it was made from, if these stay.
struct SceneGeometry {
    /// Of a valid description, without trees.
    explicit SceneGeometry(const SharedSceneDesc& desc);
    SceneGeometry(const SceneGeometry&) = delete;
    SceneGeometry& operator=(const SceneGeometry&) = delete;

    /// Would it be the same for `desc`, but for trees?
    [[nodiscard]] bool fits(const SharedSceneDesc& desc) const;
    /// Makes the trees, and takes over those of meshes from `like` that did not change.
    void build(const AnyHitFilter& filter, Isa isa, const SceneGeometry* like);

    // What the others refer to.
    SharedList<MeshDesc> meshes;
    SharedList<InstanceDesc> instances;
    SharedList<LightDesc> lights;
    SharedList<VolumeDesc> volumes;

    std::vector<PlacedMesh> placed;  // by instance
    std::vector<Sphere> spheres;
    std::vector<std::optional<MeshBox>> boxes;  // by mesh; of those with triangles
    Bounds bounds;
    BoundingSphere sphere;
    SceneCounts counts;  // lights left out
    std::optional<EmbreeScene> trees;
};

}  // namespace bdpt
