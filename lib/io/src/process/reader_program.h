#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

// Arguments and output of the program bdpt-read-ktx:
//
//     bdpt-read-ktx LIBRARY
//     bdpt-read-ktx LIBRARY WIDTH HEIGHT CHANNELS MEMORY SECONDS < IMAGE.ktx2
//
// LIBRARY is libktx or its folder; empty: the one that the system finds. WIDTH, HEIGHT and CHANNELS
// are those of the image's header, MEMORY and SECONDS (of CPU time) are limits of decoding. On its
// standard output the program writes a `KtxReply` when it has opened the library, and then the
// texels. On an error, it writes a line to its standard error and exits with an `ErrorCode`.
// Arguments and output of the program bdpt-read-vdb:
//
//     bdpt-read-vdb FILE GRID BYTES MEMORY SECONDS
//
// GRID may be empty: the usual one. BYTES limits the size of the densities, MEMORY the size of the
// tree in which the file keeps them, SECONDS the CPU time of reading it. On its standard output the
// program writes a `VdbReply` and the densities. On an error, it writes a line to its standard
// error and exits with an `ErrorCode`.

namespace bdpt::io {

// Common code of the programs that read one file for the library, in a separate process.

/// Limits of a process beyond what the program itself takes.
struct Allowance {
    std::uint64_t memory = 0;   ///< [bytes]
    std::uint64_t seconds = 0;  ///< CPU time [s]
};

/// Changes the limits of this process. Sanitizers take far more memory, so memory is not limited
/// where the program is built with them.
void allow(const Allowance& allowance);

/// Limits this process, before it reads anything. It ends with the process that started it, so it
/// ignores signals to its process group; it dumps no core.
void limit_process(const Allowance& allowance);

/// Files that a confined process may open.
enum class Openable : std::uint8_t { none, to_read };

/// Lets the kernel refuse what reading a file does not need: other system calls than those for
/// memory, time and open files fail, and starting a program or opening a connection ends the
/// process. It cannot be undone, only tightened. Without libseccomp, in kernels without seccomp and
/// with sanitizers, nothing is refused.
void confine(Openable files);

/// Writes all bytes to the standard output. Throws `Error` (output).
void write_output(const void* bytes, std::size_t size);

constexpr const char* ktx_reader_name = "bdpt-read-ktx";

/// Changes whenever anything in this file does.
constexpr std::array<char, 8> ktx_reply_start{'b', 'd', 'p', 't', 'k', 't', 'x', '1'};

/// Header of the reply, followed by texels of 8 bits a channel, row by row from the top.
struct KtxReply {
    std::array<char, 8> start = ktx_reply_start;
};

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
