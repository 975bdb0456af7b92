#pragma once

#include "volume/vdb_reply.h"

#include <openvdb/openvdb.h>

#include <cstdint>
#include <functional>
#include <span>

namespace bdpt::vdb {

/// Returns the box of the densities of `grid`: that of its active voxels, or of voxel (0, 0, 0) if
/// it has none, extended by one voxel. Throws `Error` (invalid_input) if its background is not 0,
/// or if they take more than `max_bytes`.
[[nodiscard]] io::VdbReply make_header(const openvdb::GridBase& grid, std::uint64_t max_bytes);

/// Returns the size of all densities, or of those that are in memory at a time [bytes].
[[nodiscard]] std::uint64_t density_bytes(const io::VdbReply& header);
[[nodiscard]] std::uint64_t slab_bytes(const io::VdbReply& header);

/// Passes these densities to `write` in pieces, x fastest.
void write_densities(const openvdb::GridBase& grid, const io::VdbReply& header,
                     const std::function<void(std::span<const float>)>& write);

}  // namespace bdpt::vdb
