#pragma once

#include "geometry/placed_mesh.h"
#include "geometry/ray.h"
#include "geometry/ray_passage.h"
#include "geometry/sphere.h"

#include <bdpt/isa.h>
#include <bdpt/scene_desc.h>

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace bdpt {

/// Returns for each mesh whether the filter concerns any of its instances. Each hit of these costs
/// a call.
[[nodiscard]] std::vector<bool> filtered_meshes(std::span<const InstanceDesc> instances,
                                                std::size_t mesh_count, const AnyHitFilter& filter);

/// The ray-tracing acceleration structure over all instances and spheres; the only class that calls
/// Embree. A static mesh that is used once is stored in the top level in world space, and so is
/// each use of a deforming one; others get a BVH of their own, shared by their instances.
class EmbreeScene {
public:
    /// `placed[i]` belongs to `instances[i]`; both must outlive this object, and meshes in the top
    /// level are notified (PlacedMesh::settle). `spheres` and the owner of `any_hit_filter` must
    /// outlive it, too. BVHs of meshes are reused from `like`, whose meshes are the same objects
    /// and whose `isa` is used. Throws `Error` if Embree fails, or (usage) if the CPU lacks `isa`.
    EmbreeScene(std::span<const InstanceDesc> instances, std::span<PlacedMesh> placed,
                std::size_t mesh_count, std::span<const Sphere> spheres = {},
                const AnyHitFilter& any_hit_filter = {}, Isa isa = Isa::native,
                const EmbreeScene* like = nullptr);
    /// Copies `same` with another filter, which concerns the same meshes: nothing is built.
    EmbreeScene(const EmbreeScene& same, const AnyHitFilter& any_hit_filter);
    EmbreeScene(EmbreeScene&&) noexcept;
    ~EmbreeScene();

    /// Returns the maximum origin of rays in any coordinate [m]; rays from farther away hit
    /// nothing.
    [[nodiscard]] float farthest_origin() const noexcept;
    /// Returns the instruction set of ray tracing.
    [[nodiscard]] Isa isa() const noexcept;
    /// Returns `EmbreeDevice::version()`.
    [[nodiscard]] std::string embree_version() const;
    [[nodiscard]] const AnyHitFilter& filter() const noexcept { return filter_; }
    /// Returns the result of `filtered_meshes`.
    [[nodiscard]] const std::vector<bool>& filtered() const noexcept;
    /// Identifies the BVH of a mesh that instances share: equal for the same BVH, null without one.
    [[nodiscard]] const void* tree(std::size_t mesh) const noexcept;
    /// Returns the first hit in (0, ray.t_max) that the ray does not pass. `passage`, unless null,
    /// has the rule, else chance; it may receive surfaces beyond the hit, too.
    [[nodiscard]] std::optional<RayHit> intersect(const Ray& ray,
                                                  RayPassage* passage = nullptr) const noexcept;
    /// Returns the hit of the ray at a surface that it crosses.
    [[nodiscard]] RayHit hit_at(const Ray& ray, const Crossing& crossing) const noexcept;
    /// Tests whether any surface in (0, ray.t_max) blocks the ray; if none does, `passage`, unless
    /// null, receives all surfaces that it passes.
    [[nodiscard]] bool occluded(const Ray& ray, RayPassage* passage = nullptr) const noexcept;

private:
    struct State;
    std::shared_ptr<const State> state_;
    AnyHitFilter filter_;
};

}  // namespace bdpt
