#pragma once

/// @file
/// Chooses the paths and the sharpness of a verification, and watches it.
///
/// @code{.cpp}
/// bdpt::eval::VerifyOptions options;
/// options.detectable_bias = 0.005;
/// options.merge_radius = bdpt::eval::VerifyOptions::small_merge_radius;  // tests vcm, too
/// bdpt::eval::VerifyControl control;
/// control.on_progress = [](const bdpt::eval::VerifyProgress& progress) {
///     std::cerr << progress.batches << " batches\n";
/// };
/// @endcode

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <stop_token>

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

}  // namespace bdpt::eval
