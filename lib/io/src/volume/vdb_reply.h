#pragma once

#include <array>
#include <cstdint>

// Arguments and output of the program bdpt-read-vdb:
//
//     bdpt-read-vdb FILE GRID BYTES MEMORY SECONDS
//
// GRID may be empty: the usual one. BYTES limits the size of the densities, MEMORY the size of the
// tree in which the file keeps them, SECONDS the CPU time of reading it. On its standard output the
// program writes a `VdbReply` and the densities. On an error, it writes a line to its standard
// error and exits with an `ErrorCode`.

namespace bdpt::io {

constexpr const char* vdb_reader_name = "bdpt-read-vdb";

/// Changes whenever anything in this file does.
constexpr std::array<char, 8> vdb_reply_start{'b', 'd', 'p', 't', 'v', 'd', 'b', '3'};

/// Header of the reply, followed by floats, one per voxel, x fastest, as they are in the file.
struct VdbReply {
    std::array<char, 8> start = vdb_reply_start;
    std::array<std::int32_t, 3> first{};  ///< index of the first voxel, which is its centre
    std::array<std::uint32_t, 3> size{};  ///< voxels along x, y, z
    /// 1: the grid has no active voxels, and a box of its inactive ones is passed; else 0.
    std::uint32_t empty = 0;
    /// Affine, from voxel indices, column-major.
    std::array<double, 16> world_from_index{};
    std::uint64_t tree_bytes = 0;  ///< memory of the program for the grid
    std::array<char, 256> name{};  ///< name of the grid; ends with a zero byte
};

}  // namespace bdpt::io
