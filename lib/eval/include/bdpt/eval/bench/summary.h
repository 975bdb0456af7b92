#pragma once

/// @file
/// Sums up the runs of a benchmark for each integrator.
///
/// @code{.cpp}
/// void print_summary(const bdpt::eval::SceneResult& result, double seconds)
/// {
///     for (const auto& summary : bdpt::eval::summarize(result, seconds)) {
///         const double error = summary.equal_time.error.median;
///         std::cout << bdpt::info(summary.integrator).name << ": relMSE " << error << '\n';
///     }
/// }
/// @endcode

#include <bdpt/eval/bench/bench.h>
#include <bdpt/eval/statistics/spread.h>
#include <bdpt/export.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace bdpt::eval {

/// The runs of an integrator after some samples: over seeds.
struct CurvePoint {
    std::int64_t samples = 0;
    double cpu_seconds = 0.0;  ///< median
    Spread error;              ///< relMSE without the reference's noise
};

/// The results of an integrator's runs in one of the two comparisons.
struct GoalSummary {
    std::int64_t samples = 0;
    double cpu_seconds = 0.0;   ///< median
    double wall_seconds = 0.0;  ///< median
    /// relMSE without the reference's noise; at equal time that after exactly those seconds, as if
    /// it fell with the inverse of the time from where it was measured.
    Spread error;
    Spread error_scales;  ///< the same of relMSE over scales, where blotches count
    Spread mape;
    /// The reference's noise is a third of the error or more: what is left is not sure.
    bool near_noise = false;
};

/// How many times sooner than `pt` an integrator has the error that `pt` ends with.
struct SpeedUp {
    double factor = 1.0;
    /// The run is shorter, or the error is already below at its first sample, so the time is that
    /// of an error that falls with the inverse of it.
    bool extrapolated = false;
};

/// All that is told about an integrator in a scene.
struct IntegratorSummary {
    IntegratorKind integrator = IntegratorKind::bdpt;
    int seeds = 0;
    GoalSummary equal_time;
    GoalSummary equal_samples;
    std::vector<CurvePoint> curve;
    double efficiency = 0.0;            ///< 1 / (error x CPU time) at equal time [1/s]
    std::optional<SpeedUp> speed_up{};  ///< none without runs of pt
    /// The error floor; none: the integrator finds all light.
    std::optional<double> floor{};
    std::optional<TimeSplit> time{};  ///< where it goes; none if that was not measured
    double samples_per_second = 0.0;  ///< of all pixels, in time on the wall
    double camera_rays_per_second = 0.0;
    double light_rays_per_second = 0.0;
    double shadow_rays_per_second = 0.0;
    std::optional<std::uint64_t> peak_memory{};  ///< of the process; the greatest [bytes]
    std::uint64_t invalid = 0;                   ///< samples that were dropped, in all runs
};

/// A summary for each integrator that has runs, in the order of the goals. `seconds` is the CPU
/// time that is equal.
[[nodiscard]] BDPT_EXPORT std::vector<IntegratorSummary> summarize(const SceneResult& result,
                                                                   double seconds);

/// When a curve has come down to an error.
struct TimeToError {
    double seconds = 0.0;
    bool extrapolated = false;  ///< the time is before the first point or after the last one
};

/// The time after which a curve stays at or below `error` > 0, between its points on straight lines
/// of a log-log plot; before the first and after the last as if the error fell with the inverse of
/// the time. The curve has a point and rising times.
[[nodiscard]] BDPT_EXPORT TimeToError time_to_error(const std::vector<CurvePoint>& curve,
                                                    double error);

}  // namespace bdpt::eval
