#pragma once

/// @file
/// Reads the CPU time of the process.
///
/// @code{.cpp}
/// void print_cpu_time(const bdpt::Scene& scene, const bdpt::CameraDesc& camera)
/// {
///     const double start = bdpt::eval::cpu_seconds();
///     const bdpt::RenderResult result = bdpt::render(scene, camera, {});
///     std::cout << bdpt::eval::cpu_seconds() - start << " s of CPU time\n";
/// }
/// @endcode

#include <ctime>

namespace bdpt::eval {

/// Returns the CPU time of all threads of this process so far [s], which other programs on the
/// machine disturb less than the wall-clock time.
[[nodiscard]] inline double cpu_seconds()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

}  // namespace bdpt::eval
