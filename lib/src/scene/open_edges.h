#pragma once

#include <bdpt/scene_desc.h>

#include <cstddef>

namespace bdpt {

/// Counts the edges of a mesh that lack a triangle on the other side, or have one with opposite
/// orientation: 0 for the boundary of a closed body. Vertices at the same position count as one.
/// Degenerate triangles do not count.
[[nodiscard]] std::size_t count_open_edges(const MeshDesc& mesh);

}  // namespace bdpt
