#pragma once

/// @file
/// Tests whether all strategies and integrators agree on a scene.
///
/// @code{.cpp}
/// void print_failures(const bdpt::eval::VerifyReport& report)
/// {
///     for (const bdpt::eval::StrategyFinding& finding : report.strategies) {
///         if (bdpt::eval::fails(finding.whole, report)) {
///             std::cout << bdpt::strategy_name(finding.strategy) << " disagrees\n";
///         }
///     }
/// }
/// @endcode
///
/// @code{.cpp}
/// bool agree(const bdpt::Scene& scene, const bdpt::CameraDesc& camera)
/// {
///     const bdpt::eval::VerifyOptions options = {.max_depth = 4, .seconds = 30.0};
///     const bdpt::eval::VerifyReport report = bdpt::eval::verify(scene, camera, options);
///     return report.verdict == bdpt::eval::Verdict::pass;
/// }
/// @endcode

#include <bdpt/export.h>
#include <bdpt/film/film.h>
#include <bdpt/pixel_rect.h>
#include <bdpt/render_options.h>
#include <bdpt/scene.h>
#include <bdpt/scene_desc.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

namespace bdpt::eval {

/// Samples per pixel of a batch. bdpt and mis take most of the time, as the sharpness of the
/// verdict depends on them: mis alone checks light that only one strategy of bdpt can find.
constexpr int bdpt_samples = 32;
constexpr int mis_samples = 64;    ///< samples of mis
constexpr int other_samples = 16;  ///< samples of pt, nee, lt and vcm
/// Samples of pt for paths of one edge: a single ray each, and visible area lights are often small.
constexpr int direct_samples = 64;

/// Options of `verify`: its paths, confidence and sharpness.
struct VerifyOptions {
    int width = 32;  ///< [pixels]
    int height = 32;
    /// Tiles along each side of the image; not more than pixels.
    int grid = 4;
    /// Maximum path length that is tested [edges], at least 1.
    int max_depth = 5;
    /// Light paths per camera path, the number of light paths that a camera path is connected to,
    /// and the number of chosen connections, of bdpt; see `BidirectionalOptions`.
    double light_paths = 1.0;
    std::optional<double> connections{};
    double connection_rays = 0.0;
    /// If set, `vcm` with this `BidirectionalOptions::merge_radius` is compared with bdpt as well;
    /// its image is unbiased in the limit of a radius of 0.
    std::optional<double> merge_radius{};
    /// A radius at which merging carries much of the light of 32 x 32 pixels but blurs little.
    static constexpr double small_merge_radius = 0.02;
    /// Light samples at each vertex of a camera path, of all integrators but lt and pt, in [1,
    /// 1024].
    int light_samples = 1;
    /// Probability of `Verdict::fail` for a correct renderer.
    double false_alarm = 1e-3;
    /// Relative error of the image's mean that must be found with a probability of 90 % if a
    /// strategy causes it; else the verdict is `inconclusive`.
    double detectable_bias = 0.01;
    double seconds = 120.0;  ///< time after which no more batches start [s]
    std::int64_t max_batches = std::numeric_limits<std::int64_t>::max();
    std::uint64_t seed = 0;
    int threads = 0;  ///< 0: one per hardware thread; does not change a batch's result
};

/// Progress of `verify`.
struct VerifyProgress {
    std::int64_t batches = 0;
    double seconds = 0.0;  ///< time since the start [s]
    /// Current value of the error that `VerifyOptions::detectable_bias` limits.
    double detectable = 1.0;
};

/// Hooks by which a caller watches and stops `verify`. All are optional.
struct VerifyControl {
    /// A request ends the renders; the verdict is based on the batches so far.
    std::stop_token stop;
    /// Called now and then on the thread that called verify().
    std::function<void(const VerifyProgress&)> on_progress;
};

/// The verdict of `verify`.
enum class Verdict : std::uint8_t {
    pass,          ///< no test fails, and an error that biases the image would have been found
    fail,          ///< a test fails
    inconclusive,  ///< no test fails, but noise could hide an error
};

/// Comparison of two estimates of the same light.
struct MeanComparison {
    double found = 0.0;       ///< [nit]
    double expected = 0.0;    ///< [nit]
    double error = 0.0;       ///< standard error of `found - expected` [nit]
    double z = 0.0;           ///< difference in standard errors
    double p = 1.0;           ///< probability of such a difference if both means are equal
    double p_adjusted = 1.0;  ///< p after Holm's correction for all tests of its family
    /// Relative error of the image's mean that would be found with a probability of 90 %; infinite
    /// if another comparison must find it. For the whole image only.
    double detectable = std::numeric_limits<double>::infinity();
};

/// Comparison of a strategy with all that find the same paths.
struct StrategyFinding {
    Strategy strategy;
    /// Fraction of the light of paths of this length that the strategy cannot sample; in [0, 1].
    double blind = 0.0;
    double weighted = 0.0;    ///< mean MIS-weighted contribution to the image [nit]
    double unweighted = 0.0;  ///< mean unweighted estimate [nit]; may be very noisy
    /// Part of `weighted` along paths that no other strategy can sample [nit].
    double solitary = 0.0;
    MeanComparison whole;                    ///< in the whole image
    std::vector<MeanComparison> tiles;       ///< row by row
    std::vector<MeanComparison> channels{};  ///< red, green and blue in the whole image
};

/// Comparison of an integrator with those paths of bdpt that it can sample, for one path length.
struct IntegratorFinding {
    IntegratorKind integrator = IntegratorKind::pt;
    int edges = 0;
    MeanComparison whole;
    std::vector<MeanComparison> tiles;
    std::vector<MeanComparison> channels{};
};

/// Comparison of merging with all strategies that find the same paths, for one path length.
struct MergeFinding {
    int edges = 0;
    double brought = 0.0;  ///< mean contribution of merging to the image of vcm [nit]
    MeanComparison whole;
    std::vector<MeanComparison> channels{};
};

/// The light of all paths of one length.
struct LengthFinding {
    int edges = 0;
    double radiance = 0.0;  ///< mean over the image, by bdpt [nit]
    double error = 0.0;     ///< standard error of `radiance` [nit]
    /// Fractions of the light that pt, nee and mis can sample, and that lt can sample; in [0, 1].
    double seen_from_camera = 0.0;
    double seen_from_light = 0.0;
};

/// An integrator's mean of the image, over all path lengths that are tested.
struct ImageFinding {
    IntegratorKind integrator = IntegratorKind::bdpt;
    double radiance = 0.0;  ///< [nit]
    double error = 0.0;     ///< standard error [nit]
    FilmDefects defects;
    /// Greatest difference in a tile between the image and the sum of the paths reported for it,
    /// relative to the tile.
    double lost = 0.0;
};

/// Check of the MIS weights of single paths.
struct WeightFinding {
    std::int64_t paths = 0;
    /// Paths whose weight differs by more than 0.001 from the definition, by which the weights of
    /// all strategies of a path sum to one.
    std::int64_t wrong = 0;
    double worst = 0.0;  ///< greatest difference from the definition
};

/// The result of `verify`.
struct VerifyReport {
    Verdict verdict = Verdict::inconclusive;
    std::int64_t batches = 0;
    double seconds = 0.0;
    /// Mean of the image [nit].
    double radiance = 0.0;
    /// Relative error of the image's mean that would have been found with a probability of 90 % if
    /// a strategy caused it. Infinite if there are too few samples to tell.
    double detectable = std::numeric_limits<double>::infinity();
    /// Fraction of the light along paths that only one strategy of bdpt, and none of pt, nee and
    /// mis, can sample: nothing checks it.
    double unchecked = 0.0;
    double false_alarm = 0.0;  ///< probability of a false alarm that was allowed
    std::vector<PixelRect> tiles;
    std::vector<ImageFinding> images;  ///< bdpt, pt, nee, mis, lt, and vcm if requested
    WeightFinding weights;
    std::vector<LengthFinding> lengths;
    std::vector<StrategyFinding> strategies;
    std::vector<IntegratorFinding> integrators;
    std::vector<MergeFinding> merges;  ///< if vcm was requested
    /// Relative error of the contribution of merging that would have been found with a probability
    /// of 90 %. Infinite where nothing else finds the merged light.
    double detectable_of_merging = std::numeric_limits<double>::infinity();
};

/// Greatest relative error of merging that may go undetected; beyond it the verdict is
/// inconclusive.
constexpr double max_error_of_merging = 0.25;

/// Tests whether a comparison fails. Each of the two families of tests, whole images and tiles, has
/// half of the false alarms.
[[nodiscard]] inline bool fails(const MeanComparison& comparison, const VerifyReport& report)
{
    return comparison.p_adjusted <= 0.5 * report.false_alarm;
}

/// Tests whether the image lacks light of its paths, or has light of no path. Rounding to single
/// precision loses far less.
[[nodiscard]] inline bool loses_light(const ImageFinding& image)
{
    return !(image.lost <= 1e-3);
}

/// Verifies the estimators on a scene: renders it by all integrators and compares each strategy of
/// bdpt with all that find the same paths, and the other integrators with bdpt, for each path
/// length, in the whole image and in tiles. docs/verify.md describes the method. Blocks until the
/// result is sharp enough, the time is up or a stop is requested; at least eight batches are
/// rendered. Results are bit-identical for equal options and numbers of batches. Throws `Error`:
/// usage for options out of range, invalid_input for an unusable camera.
[[nodiscard]] BDPT_EXPORT VerifyReport verify(const Scene& scene, const CameraDesc& camera,
                                              const VerifyOptions& options,
                                              const VerifyControl& control = {});

/// Returns "pass", "fail" or "inconclusive".
[[nodiscard]] BDPT_EXPORT std::string_view to_string(Verdict verdict);

/// Returns the report as one line of JSON, as described in docs/verify.md, with a line break.
/// Numbers that are not finite are null; bytes of `scene` that are not UTF-8 are replaced.
[[nodiscard]] BDPT_EXPORT std::string verify_json(const VerifyReport& report,
                                                  std::string_view scene);

}  // namespace bdpt::eval
