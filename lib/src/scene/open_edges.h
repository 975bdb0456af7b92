#pragma once

#include <bdpt/scene_desc.h>

#include <cstddef>

namespace bdpt {

/// How many edges of a mesh lack a triangle on the other side, or have one that faces the other
/// way: 0 for the boundary of a closed body. Vertices at one place count as one. Triangles without
/// area do not count.
[[nodiscard]] std::size_t count_open_edges(const MeshDesc& mesh);

}  // namespace bdpt
