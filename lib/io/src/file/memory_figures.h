#pragma once

#include <string>

namespace bdpt::io {

/// For the message about an allocation that failed: how much memory this process had at most, and
/// how much it may have by its limit (ulimit -v), else how much the machine has.
[[nodiscard]] std::string memory_figures();

}  // namespace bdpt::io
