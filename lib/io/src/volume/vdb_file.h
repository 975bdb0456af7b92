#pragma once

#include "volume/vdb_reply.h"

#include <bdpt/io/volume.h>

#include <filesystem>
#include <vector>

namespace bdpt::io {

/// A grid as stored in a file.
struct VdbGrid {
    VdbReply header;
    std::vector<float> density;  ///< x fastest
};

/// Reads a grid of an OpenVDB file, by a separate process. Throws `Error` as `load_volume` does,
/// without the name of the file.
[[nodiscard]] VdbGrid read_vdb(const std::filesystem::path& file, const VolumeOptions& options);

}  // namespace bdpt::io
