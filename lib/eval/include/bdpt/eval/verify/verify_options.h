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

/// Samples a pixel of a batch. bdpt and mis have most of the time: how sharp the verdict is hangs
/// on them, for mis is the one to check what only one strategy of bdpt can make.
constexpr int bdpt_samples = 32;
constexpr int mis_samples = 64;    ///< of mis
constexpr int other_samples = 16;  ///< of pt, nee, lt and vcm
/// Of pt for paths of one edge: a single ray each, and lamps that are seen are often small.
constexpr int direct_samples = 64;

/// The options of `verify`: its paths, confidence and sharpness.
struct VerifyOptions {
    int width = 32;  ///< [pixels]
    int height = 32;
    /// Tiles along each side of the image; not more than there are pixels.
    int grid = 4;
    /// Longest paths that are tested [edges], at least 1.
    int max_depth = 5;
    /// Light paths for each camera path, and how many of them it is connected to, of bdpt; as
    /// `BidirectionalOptions` has them.
    double light_paths = 1.0;
    std::optional<double> connections{};
    /// If there is one, `vcm` is held against bdpt as well, with that
    /// `BidirectionalOptions::merge_radius`: its image is right in the limit of none.
    std::optional<double> merge_radius{};
    /// Merging has a good part of the light of 32 x 32 pixels then, and blurs little.
    static constexpr double small_merge_radius = 0.02;
    /// Light samples at each vertex of a camera path, of all integrators but lt and pt, in [1,
    /// 1024].
    int light_samples = 1;
    /// Chance of `Verdict::fail` for a renderer without fault.
    double false_alarm = 1e-3;
    /// Errors of a strategy that change the mean of the image by this fraction must be found with
    /// 90 % chance; else the verdict is `inconclusive`.
    double detectable_bias = 0.01;
    double seconds = 120.0;  ///< after which no more batches start
    std::int64_t max_batches = std::numeric_limits<std::int64_t>::max();
    std::uint64_t seed = 0;
    int threads = 0;  ///< 0: one for each hardware thread; no influence on what a batch brings
};

/// How far `verify` is.
struct VerifyProgress {
    std::int64_t batches = 0;
    double seconds = 0.0;     ///< [s] since the start
    double detectable = 1.0;  ///< what `VerifyOptions::detectable_bias` asks for, as it is now
};

/// How a caller watches and stops `verify`. Everything is optional.
struct VerifyControl {
    /// A request ends the renders; what is there is judged.
    std::stop_token stop;
    /// Called now and then on the thread that called verify().
    std::function<void(const VerifyProgress&)> on_progress;
};

}  // namespace bdpt::eval
