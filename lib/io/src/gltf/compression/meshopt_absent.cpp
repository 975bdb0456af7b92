// Replaces meshopt_decoder.cpp in builds without meshoptimizer.
#include "gltf/compression/meshopt_decoder.h"

#include <bdpt/error.h>

namespace bdpt::io {

bool has_meshopt()
{
    return false;
}

Bytes decode_meshopt(const MeshoptStream&, ByteView)
{
    throw Error(ErrorCode::unsupported, "this build of bdpt has no meshoptimizer");
}

}  // namespace bdpt::io
