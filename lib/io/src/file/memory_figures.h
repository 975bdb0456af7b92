#pragma once

#include <string>

namespace bdpt::io {

/// Returns, for the message about a failed allocation, the peak memory of this process, and its
/// limit (ulimit -v) or else the memory of the machine.
[[nodiscard]] std::string memory_figures();

}  // namespace bdpt::io
