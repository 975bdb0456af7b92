#pragma once

#include <ctime>

namespace bdpt::eval {

/// Returns the CPU time of all threads of this process so far [s], which other programs on the
/// machine disturb less than the wall-clock time.
[[nodiscard]] inline double cpu_seconds()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace bdpt::eval
