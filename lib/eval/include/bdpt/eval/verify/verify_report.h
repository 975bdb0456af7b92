#pragma once

/// @file
/// Holds the findings of a verification.
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

#include <bdpt/film/film.h>
#include <bdpt/pixel_rect.h>
#include <bdpt/render_options.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

namespace bdpt::eval {

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

}  // namespace bdpt::eval
