#pragma once

#include <ctime>

namespace bdpt::eval {

/// CPU time of all threads of this process so far [s]: other programs on the machine count less in
/// it than on a clock at the wall.
[[nodiscard]] inline double cpu_seconds()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace bdpt::eval
