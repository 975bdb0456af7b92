#pragma once

/// @file
/// Runs the integrators on a scene, to compare their errors.
///
/// @code{.cpp}
/// void bench(const bdpt::eval::BenchScene& scene)
/// {
///     const bdpt::eval::BenchOptions options = {.seconds = 10.0, .seeds = 3};
///     if (const auto result = bdpt::eval::run_scene(scene, options, "out/bench", {})) {
///         std::cout << result->name << ": " << result->runs.size() << " runs\n";
///     }
/// }
/// @endcode

#include <bdpt/eval/bench/bench_options.h>
#include <bdpt/eval/bench/bench_run.h>
#include <bdpt/eval/bench/bench_scene.h>
#include <bdpt/eval/bench/reference.h>
#include <bdpt/eval/bench/time_split.h>
#include <bdpt/export.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace bdpt::eval {

/// How far the work on a scene is, in CPU time [s] as it was planned.
struct BenchProgress {
    double worked = 0.0;   ///< what has been done, without what was found in the folder
    double left = 0.0;     ///< what is still to do
    std::string activity;  ///< "bdpt, seed 2"
};

/// How a caller watches and stops a benchmark. Everything is optional.
struct BenchControl {
    std::stop_token stop;  ///< ends it after the pass in flight; finished runs are kept
    std::function<void(const BenchProgress&)> on_progress;
    std::function<void(const std::string&)> on_note;  ///< one line for people
};

/// The error floor of an integrator, which stays however long it renders.
struct ErrorFloor {
    IntegratorKind integrator = IntegratorKind::bdpt;
    double relmse = 0.0;
};

/// The result of a scene's benchmark, finished or stopped.
struct SceneResult {
    std::string name;
    std::string file;
    std::string environment;
    std::string camera;
    std::string content;  ///< hash of scene and camera, as text
    int width = 0;        ///< [pixels]
    int height = 0;
    double light_scale = 1.0;  ///< mean of the reference's components [nit]
    double reference_noise = 0.0;
    std::string reference_origin;
    std::filesystem::path reference_file;
    std::vector<BenchGoals> goals;
    std::vector<BenchRun> runs;        ///< by seed, then in the order of the integrators
    std::vector<ErrorFloor> floors{};  ///< of integrators that cannot find all light
    std::vector<TimeSplit> splits{};   ///< of integrators whose time has been measured
    bool complete = false;             ///< all runs were made
};

/// CPU time that a scene takes at about, with its reference [s].
[[nodiscard]] BDPT_EXPORT double planned_seconds(const BenchOptions& options);

/// Where a run's image at equal time is.
[[nodiscard]] BDPT_EXPORT std::filesystem::path image_file(const std::filesystem::path& folder,
                                                           const std::string& scene,
                                                           IntegratorKind integrator,
                                                           std::uint64_t seed);

/// All files that `run_scene` may write, for whoever has to clean up after it.
[[nodiscard]] BDPT_EXPORT std::vector<std::filesystem::path> scene_files(
    const std::filesystem::path& folder, const std::string& scene, const BenchOptions& options);

/// Runs every integrator with every seed in turn (A B C A B C ...), so that a machine that gets
/// slower or busier does so for all. A run is rendered up to the samples that take `seconds`, which
/// are found out first, or to those of the comparison at equal samples, whichever are more, and
/// looked at on its way. All runs, their images and the reference are kept in `folder`; those
/// that are there already are not made again. None if stopped before there was a reference.
///
/// Throws `Error`, whose message names the file: output when one cannot be written; usage when the
/// folder holds runs of another scene or with other options; not_found or invalid_input when what
/// it holds, or the given reference, cannot be read or used; those of render().
[[nodiscard]] BDPT_EXPORT std::optional<SceneResult> run_scene(const BenchScene& scene,
                                                               const BenchOptions& options,
                                                               const std::filesystem::path& folder,
                                                               const BenchControl& control);

}  // namespace bdpt::eval
