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
#include <bdpt/export.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace bdpt::eval {

/// Progress of the work on a scene, in CPU time [s] as planned.
struct BenchProgress {
    double worked = 0.0;   ///< time done, without results found in the folder
    double left = 0.0;     ///< time still planned
    std::string activity;  ///< "bdpt, seed 2"
};

/// Hooks by which a caller watches and stops a benchmark. All are optional.
struct BenchControl {
    std::stop_token stop;  ///< stops after the pass in flight; finished runs are kept
    std::function<void(const BenchProgress&)> on_progress;
    std::function<void(const std::string&)> on_note;  ///< receives one line for people
};

/// The error floor of an integrator: the error that remains however long it renders.
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
    std::vector<ErrorFloor> floors{};  ///< floors of the integrators that cannot find all light
    bool complete = false;             ///< true if all runs were made
};

/// Returns the approximate CPU time for a scene, including its reference [s].
[[nodiscard]] BDPT_EXPORT double planned_seconds(const BenchOptions& options);

/// Returns the path of a run's image at equal time.
[[nodiscard]] BDPT_EXPORT std::filesystem::path image_file(const std::filesystem::path& folder,
                                                           const std::string& scene,
                                                           IntegratorKind integrator,
                                                           std::uint64_t seed);

/// Returns all files that `run_scene` may write, so that a caller can remove them.
[[nodiscard]] BDPT_EXPORT std::vector<std::filesystem::path> scene_files(
    const std::filesystem::path& folder, const std::string& scene, const BenchOptions& options);

/// Runs every integrator with every seed, interleaved (A B C A B C ...), so that a machine that
/// slows down does so for all integrators. A run renders as many samples as take `seconds`
/// (measured first), or the samples of the comparison at equal samples, whichever is more, and
/// records checkpoints. Runs, their images and the reference are kept in `folder`; existing ones
/// are not rendered again. Returns none if stopped before there was a reference.
///
/// Throws `Error`, whose message names the file: output if a file cannot be written; usage if the
/// folder holds runs of another scene or with other options; not_found or invalid_input if its
/// contents, or the given reference, cannot be read or used; the errors of render().
[[nodiscard]] BDPT_EXPORT std::optional<SceneResult> run_scene(const BenchScene& scene,
                                                               const BenchOptions& options,
                                                               const std::filesystem::path& folder,
                                                               const BenchControl& control);

}  // namespace bdpt::eval
