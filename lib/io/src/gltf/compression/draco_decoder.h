#pragma once

#include "file/bytes.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace bdpt::io {

/// An attribute as it should come out of a Draco mesh.
struct DracoAttribute {
    std::uint32_t id = 0;              ///< unique in the mesh
    std::uint64_t component_type = 0;  ///< of glTF
    std::size_t components = 0;        ///< of an element, 1 to 16
};

/// How large a Draco mesh says it is.
struct DracoSize {
    std::uint64_t faces = 0;
    std::uint64_t vertices = 0;  ///< there may be more points: up to 3 for each face
};

struct DracoMesh {
    std::size_t points = 0;
    std::vector<Bytes> attributes;       ///< elements one after the other, one for each point
    std::vector<std::uint32_t> indices;  ///< three for each triangle, each below `points`
};

/// Does this build have Draco?
[[nodiscard]] bool has_draco();

/// Reads the head of a mesh, which costs nothing. Throws `Error`: invalid_input for what is no
/// mesh, unsupported for bitstreams other than 2.2, which is that of KHR_draco_mesh_compression.
[[nodiscard]] DracoSize draco_size(ByteView data);

/// Throws `Error`: invalid_input for data that is broken, lacks an attribute or has attributes of
/// more than `most` bytes, unsupported in builds without Draco.
[[nodiscard]] DracoMesh decode_draco_mesh(ByteView data, std::span<const DracoAttribute> attributes,
                                          std::uint64_t most);

}  // namespace bdpt::io
