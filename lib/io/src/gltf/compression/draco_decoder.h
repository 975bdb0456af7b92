#pragma once

#include "file/bytes.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace bdpt::io {

/// An attribute to decode from a Draco mesh.
struct DracoAttribute {
    std::uint32_t id = 0;              ///< unique in the mesh
    std::uint64_t component_type = 0;  ///< as in glTF
    std::size_t components = 0;        ///< per element, 1 to 16
};

/// Size of a Draco mesh according to its header.
struct DracoSize {
    std::uint64_t faces = 0;
    std::uint64_t vertices = 0;  ///< there may be more points: up to 3 for each face
};

struct DracoMesh {
    std::size_t points = 0;
    std::vector<Bytes> attributes;       ///< elements one after the other, one per point
    std::vector<std::uint32_t> indices;  ///< three per triangle, each below `points`
};

/// Tests whether this build has Draco.
[[nodiscard]] bool has_draco();

/// Reads the header of a mesh, which is cheap. Throws `Error`: invalid_input for data that is no
/// mesh, unsupported for bitstreams other than 2.2, the version of KHR_draco_mesh_compression.
[[nodiscard]] DracoSize draco_size(ByteView data);

/// Decodes a mesh. Throws `Error`: invalid_input for data that is broken, lacks an attribute or has
/// attributes of more than `most` bytes, unsupported in builds without Draco.
[[nodiscard]] DracoMesh decode_draco_mesh(ByteView data, std::span<const DracoAttribute> attributes,
                                          std::uint64_t most);

}  // namespace bdpt::io
