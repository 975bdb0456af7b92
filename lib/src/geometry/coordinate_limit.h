#pragma once

#include <bdpt/scene_desc.h>

#include <cstddef>
#include <span>

namespace bdpt {

/// Maximum distance from the origin in each coordinate [m]: products of four such numbers overflow,
/// but products of two stay finite.
inline constexpr float max_coordinate = 1e15f;

/// Returns the maximum distance of surfaces and lights of a scene from the origin [m]. At most
/// `max_coordinate`, and less if a mesh that several instances share, or one that moves, is scaled
/// down very much: Embree transforms rays to the space of such a mesh, and terminates the process
/// if a coordinate exceeds 1.8e18 there.
[[nodiscard]] float compute_coordinate_limit(std::span<const InstanceDesc> instances,
                                             std::size_t mesh_count);

/// Returns the largest coordinate of the corners of a mesh's bounds, in all of its poses.
[[nodiscard]] Vec3 compute_extent(const MeshDesc& mesh);

/// Returns the largest coordinate that a mesh of this extent can have in the world [m].
[[nodiscard]] float placed_extent(Vec3 extent, const Mat4& world_from_object);

}  // namespace bdpt
