// Replaces draco_decoder.cpp in builds without Draco.
#include "gltf/compression/draco_decoder.h"

#include <bdpt/error.h>

namespace bdpt::io {

namespace {

constexpr const char* message = "this build of bdpt has no Draco";

}  // namespace

bool has_draco()
{
    return false;
}

DracoSize draco_size(ByteView)
{
    throw Error(ErrorCode::unsupported, message);
}

DracoMesh decode_draco_mesh(ByteView, std::span<const DracoAttribute>, std::uint64_t)
{
    throw Error(ErrorCode::unsupported, message);
}

}  // namespace bdpt::io
