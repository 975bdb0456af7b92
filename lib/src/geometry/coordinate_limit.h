#pragma once

#include <bdpt/scene_desc.h>

#include <cstddef>
#include <span>

namespace bdpt {

/// The farthest from the origin that anything may be [m], in each coordinate: products of four such
/// numbers overflow, but what is computed from two stays finite.
inline constexpr float max_coordinate = 1e15f;

/// How far from the origin surfaces and lights of a scene may be [m]. At most
/// `max_coordinate`, and less when a mesh that several instances share, or one that moves, is
/// scaled down very much: Embree takes rays to the space of such a mesh, and ends the process when
/// a coordinate is above 1.8e18 there.
[[nodiscard]] float coordinate_limit_of(std::span<const InstanceDesc> instances,
                                        std::size_t mesh_count);

/// The greatest coordinate of the corners of a mesh's bounds, in all of its poses.
[[nodiscard]] Vec3 extent_of(const MeshDesc& mesh);

/// The greatest coordinate that a mesh of this extent can have in the world [m].
[[nodiscard]] float placed_extent(Vec3 extent, const Mat4& world_from_object);

}  // namespace bdpt
