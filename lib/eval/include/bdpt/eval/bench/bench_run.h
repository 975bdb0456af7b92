#pragma once

/// @file
/// Records how the error of a render falls with its samples.
///
/// @code{.cpp}
/// void print_run(const bdpt::eval::BenchRun& run)
/// {
///     for (const bdpt::eval::Checkpoint& point : run.checkpoints) {
///         std::cout << point.samples << " samples: relMSE " << point.relmse << '\n';
///     }
/// }
/// @endcode

#include <bdpt/render_options.h>
#include <bdpt/render_stats.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace bdpt::eval {

/// How far a run was after some samples. Errors hold the noise of the reference too.
struct Checkpoint {
    std::int64_t samples = 0;   ///< per pixel
    double cpu_seconds = 0.0;   ///< of all threads [s]
    double wall_seconds = 0.0;  ///< [s]
    double relmse = 0.0;
    double relmse_scales = 0.0;
    double mape = 0.0;
};

/// A render of a scene by an integrator with a seed of its own, looked at on its way: the samples
/// up to a checkpoint are, to the bit, what a render of just those would have made.
struct BenchRun {
    IntegratorKind integrator = IntegratorKind::bdpt;
    std::uint64_t seed = 0;
    std::vector<Checkpoint> checkpoints;         ///< rising samples
    RenderStats stats{};                         ///< of all samples
    std::uint64_t invalid = 0;                   ///< `FilmDefects`
    std::uint64_t saturated = 0;                 ///< the same
    std::optional<std::uint64_t> peak_memory{};  ///< of the process during the run [bytes]
};

/// How many samples an integrator takes in the two comparisons.
struct BenchGoals {
    IntegratorKind integrator = IntegratorKind::bdpt;
    std::int64_t equal_time = 0;
    std::int64_t equal_samples = 0;
};

}  // namespace bdpt::eval
