#pragma once

#include <cstddef>
#include <cstdint>

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

}  // namespace bdpt::io
