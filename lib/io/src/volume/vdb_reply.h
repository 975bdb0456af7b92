#pragma once

#include <array>
#include <cstdint>

// What the program bdpt-read-vdb is given, and what it answers:
//
//     bdpt-read-vdb FILE GRID BYTES MEMORY SECONDS
//
// GRID may be empty: the usual one. BYTES is how large the densities may be, MEMORY how much the
// tree may take in which the file keeps them, SECONDS how long reading it may keep a processor. On
// its standard output the program writes a `VdbReply` and the densities. If there is an error, it
// writes a line to its standard error and ends with an `ErrorCode`.

namespace bdpt::io {

constexpr const char* vdb_reader_name = "bdpt-read-vdb";

/// Changes when anything in this file does.
constexpr std::array<char, 8> vdb_reply_start{'b', 'd', 'p', 't', 'v', 'd', 'b', '2'};

/// Followed by floats, one for each voxel, x fastest.
struct VdbReply {
    std::array<char, 8> start = vdb_reply_start;
    std::array<std::int32_t, 3> first{};  ///< index of the first voxel, which is its centre
    std::array<std::uint32_t, 3> size{};  ///< voxels along x, y, z
    /// Affine, of indices of voxels, column after column.
    std::array<double, 16> world_from_index{};
    std::array<char, 256> name{};  ///< of the grid; ends with a zero byte
};

}  // namespace bdpt::io
