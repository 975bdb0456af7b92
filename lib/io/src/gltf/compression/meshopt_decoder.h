#pragma once

#include "file/bytes.h"

#include <cstddef>
#include <cstdint>

namespace bdpt::io {

/// Contents of a stream of EXT_meshopt_compression.
enum class MeshoptMode : std::uint8_t { attributes, triangles, indices };

/// Filter to apply to decoded attributes.
enum class MeshoptFilter : std::uint8_t { none, octahedral, quaternion, exponential };

struct MeshoptStream {
    MeshoptMode mode = MeshoptMode::attributes;
    MeshoptFilter filter = MeshoptFilter::none;
    std::size_t count = 0;
    /// Size of an element [bytes]. Attributes: a multiple of 4 up to 256, with the octahedral
    /// filter 4 or 8, with the quaternion filter 8; other modes: 2 or 4.
    std::size_t stride = 0;
};

/// Tests whether this build has meshoptimizer.
[[nodiscard]] bool has_meshopt();

/// Decodes `count * stride` bytes from `data`, which may be anything. Triangles need a count that
/// is a multiple of 3. Throws `Error`: invalid_input for data that is no such stream, unsupported
/// for a newer version and in builds without meshoptimizer.
[[nodiscard]] Bytes decode_meshopt(const MeshoptStream& stream, ByteView data);

}  // namespace bdpt::io
