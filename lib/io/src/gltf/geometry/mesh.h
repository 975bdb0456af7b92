#pragma once

#include "file/load_context.h"

#include <bdpt/scene_desc.h>

#include <glm/mat4x4.hpp>
#include <tiny_gltf.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace bdpt::io {

/// One primitive of a glTF mesh, by indices.
struct PrimitiveId {
    std::size_t mesh = 0;
    std::size_t primitive = 0;

    [[nodiscard]] std::string pointer() const;
};

/// Deformation of a mesh before it is placed.
struct Deformation {
    std::vector<double> weights;           ///< weights of the morph targets; the rest are 0
    std::span<const glm::dmat4> joints{};  ///< world from bind pose; empty: no skin
};

/// Reads the triangles of a primitive; returns none if it has none, with a warning. With a skin
/// they are in world space, else in the node's space. Throws `Error` (invalid_input), for positions
/// that are not finite and indices out of range among others.
[[nodiscard]] std::optional<MeshDesc> read_primitive(const tinygltf::Model& model, PrimitiveId id,
                                                     const Deformation& deformation,
                                                     LoadContext& context);

/// Returns the triangles of indices of a strip, a fan or a list [glTF 2.0, sec. 3.7.2.1]; none for
/// modes without triangles. `mode` is that of glTF.
[[nodiscard]] std::vector<UVec3> to_triangles(const std::vector<std::uint32_t>& indices, int mode);

}  // namespace bdpt::io
