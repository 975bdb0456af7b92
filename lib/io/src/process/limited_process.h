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

/// Limits this process, before it reads anything. It ignores signals to its process group, as it
/// ends with the process that started it, and dumps no core.
void limit_process(const Allowance& allowance);

/// Writes all bytes to the standard output. Throws `Error` (output).
void write_output(const void* bytes, std::size_t size);

}  // namespace bdpt::io
