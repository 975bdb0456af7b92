#pragma once

#include <bdpt/export.h>
#include <bdpt/film/aov_film.h>
#include <bdpt/film/film.h>
#include <bdpt/film/id_film.h>
#include <bdpt/film/strategy_film.h>
#include <bdpt/part/render_part.h>
#include <bdpt/path_contribution.h>
#include <bdpt/render_options.h>
#include <bdpt/render_stats.h>
#include <bdpt/scene.h>
#include <bdpt/time_profile.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <stop_token>

namespace bdpt {

/// How far a render is; what `RenderControl::on_progress` is told.
struct Progress {
    std::int64_t samples_done = 0;   ///< per pixel
    std::int64_t samples_total = 0;  ///< per pixel
    double seconds = 0.0;            ///< [s] since render() was called
    /// noise_of() the film when it was looked at last, with `noise_samples` samples a pixel.
    std::optional<double> noise{};
    std::int64_t noise_samples = 0;
};

/// Is it measured where the time of samples goes?
enum class Profiling : std::uint8_t {
    off,
    /// For `RenderResult::profile`; the image and the counts stay the same, to the bit. Makes a
    /// render some per cent slower.
    on,
};

/// How a caller watches and stops a render. Everything is optional.
struct RenderControl {
    /// A request ends the render after the pass in flight.
    std::stop_token stop;
    /// A request ends the render in the middle of a pass, within the time of a few tiles: all
    /// samples are lost, those of earlier calls too, and a `Renderer` is empty until it renders
    /// more.
    std::stop_token abandon{};
    /// Called between passes on the thread that called render(). What it throws ends the render and
    /// reaches the caller.
    std::function<void(const Progress&)> on_progress;
    /// Called after it, with all samples that there are by then: for checkpoints.
    std::function<void(const RenderPart&)> on_part;
    /// Called for each path that brings light to the film's region, on many threads at once; slows
    /// the render down.
    std::function<void(const PathContribution&)> on_path;
    Profiling profiling = Profiling::off;
    /// No pass starts that would probably end after this [s].
    double time_limit = std::numeric_limits<double>::infinity();
    /// The render ends when noise_of() its film is not above this; 0: not for that. It looks when
    /// it has the first 16, 24, 32, 48, ... samples of those asked for (next_noise_look), and not
    /// in between, so that threads, stops and parts change nothing. What ends then is a little too
    /// dark or too bright on average: by far less than the noise, as all tiles decide together.
    double noise_goal = 0.0;
};

/// The result of render().
struct RenderResult {
    Film film;
    AovFilm aovs;             ///< of the same samples; empty if none were asked for
    IdFilm ids;               ///< likewise
    StrategyFilm strategies;  ///< of the same samples; empty if none were asked for
    RenderStats stats;
    /// The options that were used: IntegratorKind::automatic is replaced by its choice.
    RenderOptions options;
    SampleRange samples;  ///< those that are in `film`; fewer than asked for after a stop
    double seconds = 0.0;
    std::optional<TimeProfile> profile{};  ///< of the same samples; with Profiling::on
};

/// The choice of choose_integrator(), and the pilot's knowledge about it.
struct IntegratorChoice {
    RenderOptions options{};
    /// Estimated share of the light of the image that `options` cannot find, in [0, 1]: caustics of
    /// the sun or of lights without extent, seen in mirrors or through glass. Only `vcm` finds it.
    /// 0 if the pilot found none, or if there was none.
    double unseen_light = 0.0;
};

/// `options` with another integrator in the place of IntegratorKind::automatic: mis, or bdpt with
/// `light_paths` and `connections`. It is chosen by a pilot, a short render of its own, and depends
/// on the scene, the camera and the options, but not on seed, samples, crop or threads. bdpt with
/// one light path if the options limit or show strategies, or ask for another heuristic than
/// balance and power. Other integrators stay as they are. A request of `abandon` ends the pilot
/// within the time of a few rows of its pixels; the choice is then worth nothing. Throws `Error` as
/// render() does.
[[nodiscard]] BDPT_EXPORT IntegratorChoice choose_integrator(const Scene& scene,
                                                             const CameraDesc& camera,
                                                             const RenderOptions& options,
                                                             const std::stop_token& abandon = {});
/// The options that choose_integrator() returns.
[[nodiscard]] BDPT_EXPORT RenderOptions chosen_options(const Scene& scene, const CameraDesc& camera,
                                                       const RenderOptions& options);

/// Estimated share, in [0, 1], of the scattered light at the camera that comes by paths of more
/// than `max_depth` edges, which `options` leave out; 0 if it cannot be told from noise. A short
/// render of its own measures it; it depends on scene, camera, size of the film and `max_depth`. It
/// is 0 without a render where nothing is lost: if no medium scatters light and `max_depth` is not
/// below its default, and from 512 edges on. Throws `Error` as render() does.
[[nodiscard]] BDPT_EXPORT double light_beyond_max_depth(const Scene& scene,
                                                        const CameraDesc& camera,
                                                        const RenderOptions& options);

/// Blocks until all samples are done, the noise is low enough, `control.stop` is requested or the
/// time is up; at least one pass is always done. The result depends on scene, camera and options
/// only, to the bit: not on threads, tiles or time. May be called from several threads at once, for
/// the same scene too. Throws `Error`: usage for options out of range and for images of strategies
/// that would take more than `strategy_memory`, invalid_input for a camera that is not usable.
[[nodiscard]] BDPT_EXPORT RenderResult render(const Scene& scene, const CameraDesc& camera,
                                              const RenderOptions& options,
                                              const RenderControl& control = {});

/// The result of render_part().
struct PartResult {
    RenderPart part;                       ///< `so_far` and what was rendered
    RenderOptions options{};               ///< as in `RenderResult`
    double seconds = 0.0;                  ///< of this call
    std::optional<TimeProfile> profile{};  ///< of the samples of this call; with Profiling::on
};

/// Continues `so_far`, or begins if that has no samples: renders the missing samples of `options`
/// into its films. If samples are missing, and the noise is above the goal if there is one, at
/// least one pass is done. Merged parts of a render have the bits of one render() of all their
/// samples, however they were split. `control` observes the samples of this call. Throws as
/// render() does, and `Error` (invalid_input) when `so_far` belongs to another render; the message
/// names the difference.
[[nodiscard]] BDPT_EXPORT PartResult render_part(const Scene& scene, const CameraDesc& camera,
                                                 const RenderOptions& options, RenderPart so_far,
                                                 const RenderControl& control = {});

/// The same, for those who do not go on. `RenderResult::samples` are the first range of the part's.
[[nodiscard]] BDPT_EXPORT RenderResult result_of(PartResult done);

/// Memory that the images of strategies of this render take [bytes], with the layers that they are
/// developed to; 0 if none are asked for. Throws `Error` (usage) for options out of range.
[[nodiscard]] BDPT_EXPORT std::uint64_t strategy_image_bytes(const RenderOptions& options,
                                                             const CameraDesc& camera);

}  // namespace bdpt
