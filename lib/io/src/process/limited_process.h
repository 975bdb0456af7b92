#pragma once

#include <cstddef>
#include <cstdint>

namespace bdpt::io {

// What programs share that read one file for the library, in a process of their own.

/// What a process may use besides what the program itself takes.
struct Allowance {
    std::uint64_t memory = 0;   ///< [bytes]
    std::uint64_t seconds = 0;  ///< of a processor
};

/// Changes what this process may use. Sanitizers take far more memory, so it is not limited where
/// the program is built with them.
void allow(const Allowance& allowance);

/// Limits this process, before it reads anything. It ignores signals that are sent to a group of
/// processes, as it ends with the process that started it, and dumps no core.
void limit_process(const Allowance& allowance);

/// Writes all bytes to the standard output. Throws `Error` (output).
void write_output(const void* bytes, std::size_t size);

}  // namespace bdpt::io
