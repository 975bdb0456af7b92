#include "gltf/compression/compression.h"

#include <bdpt/error.h>

#ifdef BDPT_HAS_MESHOPT
#include <meshoptimizer.h>
#endif

namespace bdpt::io {

#ifdef BDPT_HAS_MESHOPT

namespace {

int decode(const MeshoptStream& stream, ByteView data, Bytes& decoded)
{
    switch (stream.mode) {
        case MeshoptMode::triangles:
            return meshopt_decodeIndexBuffer(decoded.data(), stream.count, stream.stride,
                                             data.data(), data.size());
        case MeshoptMode::indices:
            return meshopt_decodeIndexSequence(decoded.data(), stream.count, stream.stride,
                                               data.data(), data.size());
        case MeshoptMode::attributes:
            break;
    }
    return meshopt_decodeVertexBuffer(decoded.data(), stream.count, stream.stride, data.data(),
                                      data.size());
}

void apply_filter(const MeshoptStream& stream, Bytes& decoded)
{
    switch (stream.filter) {
        case MeshoptFilter::none:
            return;
        case MeshoptFilter::octahedral:
            return meshopt_decodeFilterOct(decoded.data(), stream.count, stream.stride);
        case MeshoptFilter::quaternion:
            return meshopt_decodeFilterQuat(decoded.data(), stream.count, stream.stride);
        case MeshoptFilter::exponential:
            return meshopt_decodeFilterExp(decoded.data(), stream.count, stream.stride);
    }
}

/// Tests for attributes of the version after 0, which older libraries do not read.
bool is_newer(const MeshoptStream& stream, ByteView data)
{
    return stream.mode == MeshoptMode::attributes && !data.empty() && data[0] == 0xa1;
}

}  // namespace

bool has_meshopt()
{
    return true;
}

Bytes decode_meshopt(const MeshoptStream& stream, ByteView data)
{
    Bytes decoded(stream.count * stream.stride);
    if (decode(stream, data, decoded) != 0) {
        if (is_newer(stream, data)) {
            throw Error(ErrorCode::unsupported,
                        "attributes of version 1, which the meshoptimizer of this build does not "
                        "read");
        }
        throw Error(ErrorCode::invalid_input, "the data is not a meshopt stream of this size");
    }
    apply_filter(stream, decoded);
    return decoded;
}

#else

bool has_meshopt()
{
    return false;
}

Bytes decode_meshopt(const MeshoptStream&, ByteView)
{
    throw Error(ErrorCode::unsupported, "this build of bdpt has no meshoptimizer");
}

#endif

}  // namespace bdpt::io
