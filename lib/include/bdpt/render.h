#pragma once

/// @file
/// Renders a scene into a film.
///
/// @code{.cpp}
/// void render_to_file(const bdpt::Scene& scene, const bdpt::CameraDesc& camera)
/// {
///     bdpt::RenderControl control;
///     control.noise_goal = 0.02;
///     const bdpt::RenderOptions options = {.sampling = {.samples = {0, 4096}}};
///     const bdpt::RenderResult result = bdpt::render(scene, camera, options, control);
///     bdpt::io::write_exr("out.exr", result.image(), {});
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/part/render_result.h>
#include <bdpt/path_contribution.h>
#include <bdpt/render_options.h>
#include <bdpt/scene.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stop_token>

namespace bdpt {

/// Progress of a render, passed to `RenderControl::on_progress`.
struct Progress {
    std::int64_t samples_done = 0;   ///< per pixel
    std::int64_t samples_total = 0;  ///< per pixel
    double seconds = 0.0;            ///< time since render() was called [s]
    /// Last estimate_noise() of the film, at `noise_samples` samples per pixel.
    std::optional<double> noise{};
    std::int64_t noise_samples = 0;
};

/// Observation and control of a render. Everything is optional.
struct RenderControl {
    /// A request ends the render after the current pass.
    std::stop_token stop;
    /// A request ends the render in the middle of a pass, within the time of a few tiles: all
    /// samples are lost, including those of earlier calls, and a `Renderer` is empty until it
    /// renders more.
    std::stop_token abandon{};
    /// Called between passes on the thread that called render(). An exception it throws ends the
    /// render and reaches the caller.
    std::function<void(const Progress&)> on_progress;
    /// Called after `on_progress` with all samples so far: for checkpoints.
    std::function<void(const RenderResult&)> on_part;
    /// Called for each path that contributes light to the film's region, on many threads at once;
    /// slows the render down.
    std::function<void(const PathContribution&)> on_path;
    /// No pass starts that would probably end after this time [s].
    double time_limit = std::numeric_limits<double>::infinity();
    /// The render ends once estimate_noise() of its film is at most this; 0: no goal. The noise is
    /// measured after the first 16, 24, 32, 48, ... of the requested samples (next_noise_look) and
    /// not in between, so that threads, stops and parts change nothing. Stopping this way makes the
    /// image slightly too dark or too bright on average: by far less than the noise, as all tiles
    /// decide together.
    double noise_goal = 0.0;
};

/// The choice of choose_integrator(), and the pilot's estimate about it.
struct IntegratorChoice {
    RenderOptions options{};
    /// Estimated fraction of the image's light that `options` cannot find, in [0, 1]: caustics of
    /// the sun or of delta lights, seen in mirrors or through glass. Only `vcm` finds it. 0 if the
    /// pilot found none, or if there was no pilot.
    double unseen_light = 0.0;
    /// Rates of samples for `SamplingOptions::rates` that should reduce error times time by 6 % or
    /// more; null if there are none, or if there was no pilot. They are not part of `options`:
    /// with_rates() adds them.
    std::shared_ptr<const SampleRates> rates{};
};

/// Returns `options` with IntegratorKind::automatic replaced: by mis, or by bdpt with `light_paths`
/// and `connections`. A pilot, a short render of its own, makes the choice; it depends on the
/// scene, the camera and the options, but not on seed, samples or threads. A crop is measured as an
/// image of its own, and gets as many light paths as that would. The choice is bdpt with one light
/// path if the options limit or show strategies, or request another heuristic than balance and
/// power. Other integrators are kept. A request of `abandon` ends the pilot within the time of a
/// few rows of its pixels; the choice is then meaningless. Throws `Error` like render().
[[nodiscard]] BDPT_EXPORT IntegratorChoice choose_integrator(const Scene& scene,
                                                             const CameraDesc& camera,
                                                             const RenderOptions& options,
                                                             const std::stop_token& abandon = {});
/// Returns the options of `choice` with its rates, if it has some and the samples fit them
/// (`SampleRates::fit`).
[[nodiscard]] BDPT_EXPORT RenderOptions with_rates(const IntegratorChoice& choice);
/// Returns the options that choose_integrator() chooses, with_rates(): what render() and `Renderer`
/// render, and `bdpt render` by default.
[[nodiscard]] BDPT_EXPORT RenderOptions chosen_options(const Scene& scene, const CameraDesc& camera,
                                                       const RenderOptions& options);

/// Estimates the fraction, in [0, 1], of the scattered light at the camera that arrives by paths of
/// more than `max_depth` edges, which `options` exclude; 0 if it is below the noise. A short render
/// of its own measures it; it depends on scene, camera, size of the film and `max_depth`. It is 0
/// without a render where nothing is lost: if no medium scatters light and `max_depth` is not below
/// its default, and from 512 edges on. Throws `Error` like render().
[[nodiscard]] BDPT_EXPORT double light_beyond_max_depth(const Scene& scene,
                                                        const CameraDesc& camera,
                                                        const RenderOptions& options);

/// Renders a scene. Blocks until all samples are done, the noise goal is reached, `control.stop` is
/// requested or the time is up; completes at least one pass. The result depends on scene, camera
/// and options only, to the bit: not on threads, tiles or time. May be called from several threads
/// at once, also for the same scene. Throws `Error`: usage for options out of range and for
/// strategy images that would take more than `strategy_memory`, invalid_input for an unusable
/// camera.
[[nodiscard]] BDPT_EXPORT RenderResult render(const Scene& scene, const CameraDesc& camera,
                                              const RenderOptions& options,
                                              const RenderControl& control = {});

/// Continues `so_far`, or begins if it has no samples: renders the missing samples of `options`
/// into its films. If samples are missing, and the noise is above the goal if there is one, at
/// least one pass is completed. Merged parts of a render are bit-identical to one render() of all
/// their samples, however they were split. `control` observes the samples of this call. Throws like
/// render(), and `Error` (invalid_input) if `so_far` belongs to another render; the message names
/// the difference.
[[nodiscard]] BDPT_EXPORT RenderResult continue_render(const Scene& scene, const CameraDesc& camera,
                                                       const RenderOptions& options,
                                                       RenderResult so_far,
                                                       const RenderControl& control = {});

/// Returns the memory that the shared light paths of one sample index of this render usually take
/// [bytes]; 0 if it keeps none. `options` name an integrator.
[[nodiscard]] BDPT_EXPORT std::uint64_t light_path_bytes(const RenderOptions& options);

/// Returns the memory that the strategy images of this render take [bytes], including the developed
/// layers; 0 if none are requested. Throws `Error` (usage) for options out of range.
[[nodiscard]] BDPT_EXPORT std::uint64_t strategy_image_bytes(const RenderOptions& options,
                                                             const CameraDesc& camera);

}  // namespace bdpt
