#pragma once

/// @file
/// Chooses the integrators, the times and the seeds of a benchmark.
///
/// @code{.cpp}
/// const bdpt::eval::BenchOptions options = {.seconds = 10.0, .seeds = 3};
/// std::cout << bdpt::eval::planned_seconds(options) / 60.0 << " minutes of CPU time\n";
/// @endcode

#include <bdpt/eval/bench/integrator_kinds.h>
#include <bdpt/render_options.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

namespace bdpt::eval {

/// Options of the benchmark of each scene. Times are CPU times of all threads [s], which other
/// programs on the machine disturb less than wall-clock times.
struct BenchOptions {
    std::vector<IntegratorKind> integrators = unbiased_integrators();
    /// Render options. Integrator, size, samples and seed are ignored.
    RenderOptions render{};
    double seconds = 5.0;  ///< time of each run at equal time, > 0
    /// Samples of each run at equal samples, in [1, 2^20]; none: the greatest power of two that
    /// every integrator renders in `seconds`.
    std::optional<std::int64_t> samples{};
    int seeds = 5;  ///< runs of each integrator, in [1, 10000]; their seeds are 0, 1, 2 ...
    /// An image, or a folder with NAME.exr for each scene; none: references are rendered.
    std::optional<std::filesystem::path> reference{};
    double reference_seconds = 60.0;  ///< time of each of the two renders that make up a reference
    /// Maximum path length [edges] of the images of strategies; 0: no such images.
    int strategy_depth = 5;
};

}  // namespace bdpt::eval
