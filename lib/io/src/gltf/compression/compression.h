#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "file/json.h"
#include "file/load_context.h"
#include "file/read_file.h"

namespace bdpt::io {

/// Tracks the decoded size of compressed meshes of a file, before memory is allocated for it.
class DecodedSize {
public:
    explicit DecodedSize(LoadContext& context)
        : limits_(context.limits), memory_(context.budget.memory())
    {}

    /// Counts `count` elements of `size` bytes that `encoded` bytes hold. Throws `Error`
    /// (invalid_input) at `place` if the total exceeds the limits, or the compression ratio does.
    void add(const JsonPlace& place, std::uint64_t count, std::uint64_t size,
             std::uint64_t encoded);

    /// Returns how much may still be added [bytes].
    [[nodiscard]] std::uint64_t left() const { return limits_.buffer_bytes - total_; }

private:
    const ReadLimits& limits_;
    MemoryBudget& memory_;
    std::uint64_t total_ = 0;  // [bytes]
};

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

/// Decodes all primitives of KHR_draco_mesh_compression into separate buffers and updates the
/// document accordingly. The document has to be checked again afterwards. In builds without Draco,
/// primitives that also have uncompressed data are left as they are. Throws `Error` (invalid_input,
/// unsupported).
void decode_draco_primitives(Json& document, std::vector<Bytes>& buffers, LoadContext& context);

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

/// Tells for each buffer whether it is only a fallback for compressed views
/// [EXT_meshopt_compression, KHR_meshopt_compression], so that its bytes are not needed. Relies on
/// check_schema. Throws `Error` (unsupported) for a fallback without bytes, in builds without
/// meshoptimizer.
[[nodiscard]] std::vector<bool> find_fallback_buffers(const JsonPlace& root);

/// Decodes all compressed views into separate buffers and updates the document accordingly;
/// fallback buffers shrink to a byte. The document has to be checked again afterwards. Throws
/// `Error` (invalid_input, unsupported).
void decode_meshopt_views(Json& document, std::vector<Bytes>& buffers, LoadContext& context);

}  // namespace bdpt::io
