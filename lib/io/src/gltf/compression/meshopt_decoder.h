#pragma once

#include "file/bytes.h"

#include <cstddef>
#include <cstdint>

namespace bdpt::io {

/// What a stream of EXT_meshopt_compression holds.
enum class MeshoptMode : std::uint8_t { attributes, triangles, indices };

/// What has to be done with decoded attributes.
enum class MeshoptFilter : std::uint8_t { none, octahedral, quaternion, exponential };

struct MeshoptStream {
    MeshoptMode mode = MeshoptMode::attributes;
    MeshoptFilter filter = MeshoptFilter::none;
    std::size_t count = 0;
    /// [bytes] of an element. Attributes: a multiple of 4 up to 256, with the octahedral filter 4
    /// or 8, with that for quaternions 8; else 2 or 4.
    std::size_t stride = 0;
};

/// Does this build have meshoptimizer?
[[nodiscard]] bool has_meshopt();

/// The `count * stride` bytes that are encoded in `data`; they may be any. Triangles need a count
/// that is a multiple of 3. Throws `Error`: invalid_input for data that is no such stream,
/// unsupported for one of a newer version and in builds without meshoptimizer.
[[nodiscard]] Bytes decode_meshopt(const MeshoptStream& stream, ByteView data);

}  // namespace bdpt::io
