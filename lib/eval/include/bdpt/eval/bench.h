#pragma once

/// @file
/// Runs the integrators on a scene, to compare their errors.
///
/// @code{.cpp}
/// void print_noise(const bdpt::Film& film)
/// {
///     const bdpt::eval::HalvedImage render = {
///         .image = film.develop(), .first = film.develop_half(0), .second = film.develop_half(1)};
///     const double noise = bdpt::eval::estimate_noise(render, render.image);
///     std::cout << "relMSE of its noise: " << noise << '\n';
/// }
/// @endcode
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

#include <bdpt/eval/metric.h>
#include <bdpt/eval/statistics.h>
#include <bdpt/export.h>
#include <bdpt/image.h>
#include <bdpt/render_options.h>
#include <bdpt/render_stats.h>
#include <bdpt/scene.h>
#include <bdpt/scene_desc.h>

#include <cstdint>
#include <ctime>
#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

/// Evaluation of renders: metrics, comparisons, benchmarks, verification of estimators, reports.
namespace bdpt::eval {

/// Returns the kinds of `integrators()`, from the simplest to the one that has all strategies.
[[nodiscard]] BDPT_EXPORT std::vector<IntegratorKind> all_integrators();
/// Returns the kinds of `all_integrators()` that are unbiased.
[[nodiscard]] BDPT_EXPORT std::vector<IntegratorKind> unbiased_integrators();

/// Description of the machine and software that times depend on, beside the options; empty where
/// unknown.
struct MachineFacts {
    std::string cpu;        ///< model name
    int processors = 0;     ///< hardware threads available to this process
    std::string system;     ///< kernel and its release
    std::string compiler;   ///< compiler of the library
    std::string libraries;  ///< libraries it was built with: "Embree 3.13.5, oneTBB 2021.8.0, ..."
};

/// Returns the description of this machine.
[[nodiscard]] BDPT_EXPORT MachineFacts machine_facts();

/// A scene to benchmark.
struct BenchScene {
    std::string name;  ///< used in file names: letters, digits, "_", "-" and "."; unique per scene
    std::string file;  ///< path of the scene, for people
    std::string environment{};  ///< source of light from infinity, for people
    const Scene& scene;
    CameraDesc camera;
    int width = 0;  ///< [pixels]
    int height = 0;
};

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

/// The reference image of a scene: the best known estimate of the limit of its renders.
struct Reference {
    Image image;
    /// relMSE that the reference's own noise adds to every image compared with it.
    double noise = 0.0;
    std::string origin;  ///< origin of the image, for people
};

/// Returns the scale of relMSE and MAPE in benchmarks: epsilon is 0.01 of the reference's mean,
/// which makes errors independent of the unit of light. Throws `Error` (invalid_input) for a black
/// reference.
[[nodiscard]] BDPT_EXPORT MetricScale bench_scale(const Image& reference);

/// An image and the two half images whose mean it is.
struct HalvedImage {
    Image image;
    Image first;
    Image second;
};

/// Returns the relMSE of an image's own noise, estimated from its halves, relative to `base` of the
/// same size. Throws like `bench_scale`.
[[nodiscard]] BDPT_EXPORT double estimate_noise(const HalvedImage& image, const Image& base);

/// Combination of two renders by different integrators.
struct CombinedReference {
    Image image;
    double noise = 0.0;  ///< relMSE
    double share = 0.0;  ///< weight of the first image, by inverse noise
    /// Squared difference of the two images over the one expected from their noise.
    double agreement = 0.0;
};

/// Returns the mean of both images, weighted by the inverse of the noise that their halves show. If
/// they differ by more than that noise explains (`agreement` above 2), the second lacks light and
/// the first is taken alone. Sizes are equal. Throws like `bench_scale`.
[[nodiscard]] BDPT_EXPORT CombinedReference combine(const HalvedImage& all_light,
                                                    const HalvedImage& most_light);

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

/// Returns the CPU time of all threads of this process so far [s], which other programs on the
/// machine disturb less than the wall-clock time.
[[nodiscard]] inline double cpu_seconds()
{
    return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

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

/// What people see of an integrator's errors at equal time: the mean HDR-FLIP of the images of all
/// seeds.
struct VisibleErrors {
    IntegratorKind integrator = IntegratorKind::bdpt;
    Spread flip;
    /// FLIP of the same images denoised by `io::Denoiser`, with albedo and normals; none where that
    /// library is not found.
    std::optional<Spread> denoised_flip{};
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
    std::vector<BenchRun> runs;            ///< by seed, then in the order of the integrators
    std::vector<ErrorFloor> floors{};      ///< floors of the integrators that cannot find all light
    std::vector<VisibleErrors> visible{};  ///< of the integrators that have runs
    bool complete = false;                 ///< true if all runs were made
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
