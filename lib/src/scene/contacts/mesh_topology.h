#pragma once

#include <bdpt/scene_desc.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace bdpt {

/// Returns for each vertex the first one, in a fixed order, at the same position.
[[nodiscard]] std::vector<std::uint32_t> weld(const std::vector<Vec3>& positions);

/// The shells of a mesh: parts whose triangles are connected by edges. Where more than two
/// triangles meet at an edge, as on bodies that touch in one mesh, those are connected that bound
/// the same wedge of the inside.
struct Shells {
    std::vector<std::uint32_t> of_triangles;  ///< index of the shell of each triangle
    std::vector<bool> are_closed;             ///< by shell
    /// Number of edges that lack a triangle on the other side, or have one with opposite
    /// orientation: 0 for the boundary of a closed body. Vertices at the same position count as
    /// one. Degenerate triangles do not count.
    std::size_t open_edges = 0;
};

[[nodiscard]] Shells find_shells(const MeshDesc& mesh);

}  // namespace bdpt
