#pragma once

#include "geometry/any_hit_filter.h"
#include "geometry/placed_mesh.h"
#include "geometry/ray.h"
#include "geometry/sphere.h"

#include <bdpt/isa.h>
#include <bdpt/scene_desc.h>

#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace bdpt {

/// For each mesh: does the filter concern any of its instances? These cost each ray that comes to
/// them a call.
[[nodiscard]] std::vector<bool> filtered_meshes(std::span<const InstanceDesc> instances,
                                                std::size_t mesh_count, const AnyHitFilter& filter);

/// The ray-tracing acceleration structure over all instances and spheres; the only class that calls
/// Embree. A mesh that is used once and stands still goes into the top level in world space, and so
/// does each use of one that deforms; others get a BVH of their own, shared by their instances.
class EmbreeScene {
public:
    /// `placed[i]` belongs to `instances[i]`; both must outlive this object, and meshes that went
    /// into the top level are told so (PlacedMesh::settle). `spheres` must outlive it,
    /// too, and so must the owner of `any_hit_filter`. From `like`, whose meshes are the same
    /// objects and whose `isa` it then has, BVHs of meshes are taken over. Throws `Error` when
    /// Embree fails, or (usage) when the CPU lacks `isa`.
    EmbreeScene(std::span<const InstanceDesc> instances, std::span<PlacedMesh> placed,
                std::size_t mesh_count, std::span<const Sphere> spheres = {},
                const AnyHitFilter& any_hit_filter = {}, Isa isa = Isa::native,
                const EmbreeScene* like = nullptr);
    /// The same with another filter, which concerns the same meshes: nothing is built.
    EmbreeScene(const EmbreeScene& same, const AnyHitFilter& any_hit_filter);
    EmbreeScene(EmbreeScene&&) noexcept;
    ~EmbreeScene();

    /// Rays that start farther than that from the origin [m], in any coordinate, meet nothing.
    [[nodiscard]] float farthest_origin() const noexcept;
    /// What rays are traced with.
    [[nodiscard]] Isa isa() const noexcept;
    /// As that of `EmbreeDevice`.
    [[nodiscard]] std::string embree_version() const;
    [[nodiscard]] const AnyHitFilter& filter() const noexcept { return filter_; }
    /// As `filtered_meshes` found them.
    [[nodiscard]] const std::vector<bool>& filtered() const noexcept;
    /// What stands for the BVH of a mesh that instances share: equal where that is the same one,
    /// and null without one.
    [[nodiscard]] const void* tree(std::size_t mesh) const noexcept;
    /// The first surface that the ray does not pass.
    [[nodiscard]] std::optional<RayHit> intersect(const Ray& ray) const noexcept;
    /// Anything in (0, ray.t_max) that the ray does not pass?
    [[nodiscard]] bool occluded(const Ray& ray) const noexcept;

private:
    struct State;
    std::shared_ptr<const State> state_;
    AnyHitFilter filter_;
};

}  // namespace bdpt
