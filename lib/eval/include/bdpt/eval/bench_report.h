#pragma once

/// @file
/// Sums up a benchmark for each integrator, and writes it as JSON, as CSV and as a page of HTML.
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
///
/// @code{.cpp}
/// void write_bench(const bdpt::eval::BenchRecord& record)
/// {
///     std::ofstream("out/bench/results.json") << bdpt::eval::bench_json(record);
///     std::ofstream("out/bench/report.html") << bdpt::eval::bench_page(record, "out/bench");
/// }
/// @endcode

#include <bdpt/eval/bench.h>
#include <bdpt/eval/statistics.h>
#include <bdpt/export.h>
#include <bdpt/image.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace bdpt::eval {

/// A point of an integrator's convergence curve: its runs of all seeds after some samples.
struct CurvePoint {
    std::int64_t samples = 0;
    double cpu_seconds = 0.0;  ///< median
    Spread error;              ///< relMSE without the reference's noise
};

/// Results of an integrator's runs in one of the two comparisons.
struct GoalSummary {
    std::int64_t samples = 0;
    double cpu_seconds = 0.0;   ///< median
    double wall_seconds = 0.0;  ///< median
    /// relMSE without the reference's noise. At equal time it is extrapolated to exactly those
    /// seconds, as if it were proportional to the inverse of the time.
    Spread error;
    Spread error_scales;  ///< relmse_scales without the reference's noise, which also counts
                          ///< low-frequency noise
    Spread mape;
    /// True if the reference's noise is a third of the error or more, so that the rest is
    /// uncertain.
    bool near_noise = false;
};

/// Speed-up over `pt`: the ratio of the times to reach the final error of `pt`.
struct SpeedUp {
    double factor = 1.0;
    /// True if the time is extrapolated with an error proportional to its inverse: the run is
    /// shorter, or its error is already lower at the first sample.
    bool extrapolated = false;
};

/// Summary of an integrator in a scene.
struct IntegratorSummary {
    IntegratorKind integrator = IntegratorKind::bdpt;
    int seeds = 0;
    GoalSummary equal_time;
    GoalSummary equal_samples;
    std::vector<CurvePoint> curve;
    double efficiency = 0.0;                ///< 1 / (error x CPU time) at equal time [1/s]
    std::optional<SpeedUp> speed_up{};      ///< none without runs of pt
    std::optional<Spread> flip{};           ///< HDR-FLIP at equal time
    std::optional<Spread> denoised_flip{};  ///< HDR-FLIP of the denoised images
    /// Error floor; none: the integrator finds all light.
    std::optional<double> floor{};
    double samples_per_second = 0.0;  ///< samples of all pixels per second of wall-clock time
    double camera_rays_per_second = 0.0;
    double light_rays_per_second = 0.0;
    double shadow_rays_per_second = 0.0;
    /// Peak memory of the process, maximum over runs [bytes].
    std::optional<std::uint64_t> peak_memory{};
    std::uint64_t invalid = 0;  ///< dropped samples, in all runs
};

/// Returns a summary for each integrator that has runs, in the order of the goals. `seconds` is the
/// CPU time of the comparison at equal time.
[[nodiscard]] BDPT_EXPORT std::vector<IntegratorSummary> summarize(const SceneResult& result,
                                                                   double seconds);

/// Time at which a curve has fallen to an error.
struct TimeToError {
    double seconds = 0.0;
    /// True if the time is before the first point or after the last one.
    bool extrapolated = false;
};

/// Returns the time from which a curve stays at or below `error` > 0, interpolated linearly in
/// log-log space; before the first and after the last point the error is taken as proportional to
/// the inverse of the time. The curve has at least one point and increasing times.
[[nodiscard]] BDPT_EXPORT TimeToError time_to_error(const std::vector<CurvePoint>& curve,
                                                    double error);

/// Returns the part of the relMSE that is common to renders with different seeds. It remains
/// however long one renders: it is the light that an integrator cannot find. It is estimated from
/// products of the errors of two different renders, in which noise cancels; `noise` is that of the
/// reference. Returns none if it is less than a tenth of the error, or less than three standard
/// errors from 0. Takes at least two images of the reference's size.
[[nodiscard]] BDPT_EXPORT std::optional<double> error_floor(std::span<const Image> images,
                                                            const Image& reference, double noise);

/// A benchmark with all data needed to repeat it.
struct BenchRecord {
    BenchOptions options;
    MachineFacts machine;
    std::string started;  ///< UTC, ISO 8601
    std::string command;  ///< command line as typed
    std::vector<SceneResult> scenes;
};

/// Returns the record as a JSON object, as described in docs/bench.md.
[[nodiscard]] BDPT_EXPORT std::string bench_json(const BenchRecord& record);

/// Returns the record as CSV: a line for each checkpoint of each run.
[[nodiscard]] BDPT_EXPORT std::string bench_csv(const BenchRecord& record);

/// Returns a self-contained HTML page of the record and the images in `folder`. Throws `Error` like
/// `io::read_image`, or out_of_memory.
[[nodiscard]] BDPT_EXPORT std::string bench_page(const BenchRecord& record,
                                                 const std::filesystem::path& folder);

}  // namespace bdpt::eval
