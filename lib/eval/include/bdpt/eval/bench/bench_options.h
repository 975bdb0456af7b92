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

/// What a benchmark does with each scene. Times are CPU time of all threads [s]: other programs on
/// the machine count less in it than in the time on the wall.
struct BenchOptions {
    std::vector<IntegratorKind> integrators = unbiased_integrators();
    /// How to render. Integrator, size, samples and seed do not count.
    RenderOptions render{};
    double seconds = 5.0;  ///< of each run at equal time, > 0
    /// Of each run at equal samples, [1, 2^20]; none: the greatest power of two that every
    /// integrator manages in `seconds`.
    std::optional<std::int64_t> samples{};
    int seeds = 5;  ///< runs of each integrator, [1, 10000]; their seeds are 0, 1, 2 ...
    /// An image, or a folder with NAME.exr for each scene; none: references are rendered.
    std::optional<std::filesystem::path> reference{};
    double reference_seconds = 60.0;  ///< of each of the two renders that a reference is made of
    int strategy_depth = 5;  ///< longest paths [edges] in the images of strategies; 0: none
};

}  // namespace bdpt::eval
