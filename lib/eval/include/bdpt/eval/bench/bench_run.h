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

/// State of a run after some samples. The errors include the noise of the reference.
struct Checkpoint {
    std::int64_t samples = 0;   ///< per pixel
    double cpu_seconds = 0.0;   ///< CPU time of all threads [s]
    double wall_seconds = 0.0;  ///< wall-clock time [s]
    double relmse = 0.0;
    double relmse_scales = 0.0;
    double mape = 0.0;
};

/// A render of a scene by one integrator with one seed, measured at checkpoints. The samples up to
/// a checkpoint are bit-identical to a render of just those samples.
struct BenchRun {
    IntegratorKind integrator = IntegratorKind::bdpt;
    std::uint64_t seed = 0;
    std::vector<Checkpoint> checkpoints;         ///< in order of increasing samples
    RenderStats stats{};                         ///< over all samples
    std::uint64_t invalid = 0;                   ///< counts of `FilmDefects`
    std::uint64_t saturated = 0;                 ///< counts of `FilmDefects`
    std::optional<std::uint64_t> peak_memory{};  ///< peak of the process during the run [bytes]
};

/// Numbers of samples per pixel of an integrator in the two comparisons.
struct BenchGoals {
    IntegratorKind integrator = IntegratorKind::bdpt;
    std::int64_t equal_time = 0;
    std::int64_t equal_samples = 0;
};

}  // namespace bdpt::eval
