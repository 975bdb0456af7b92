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
    pass,          ///< nothing disagrees, and what would bias the image would have been seen
    fail,          ///< something disagrees
    inconclusive,  ///< nothing disagrees, but the noise could hide it
};

/// Two estimates of the same light.
struct MeanComparison {
    double found = 0.0;       ///< [nit]
    double expected = 0.0;    ///< [nit]
    double error = 0.0;       ///< standard error of `found - expected` [nit]
    double z = 0.0;           ///< difference in standard errors
    double p = 1.0;           ///< chance of such a difference if both means are equal
    double p_adjusted = 1.0;  ///< after Holm's correction for all tests of its family
    /// Errors that change the mean of the image by this fraction are found with 90 % chance;
    /// infinite if it takes another comparison to find them. Of the whole image only.
    double detectable = std::numeric_limits<double>::infinity();
};

/// A strategy held against all that find the same paths.
struct StrategyFinding {
    Strategy strategy;
    /// The share of the light of paths of this length that the strategy cannot make; in [0, 1].
    double blind = 0.0;
    double weighted = 0.0;    ///< what it brings to the image, on average [nit]
    double unweighted = 0.0;  ///< what it finds by itself, on average [nit]; may be very noisy
    /// Part of `weighted` along paths that no other strategy can make [nit].
    double solitary = 0.0;
    MeanComparison whole;                    ///< in the whole image
    std::vector<MeanComparison> tiles;       ///< in rows
    std::vector<MeanComparison> channels{};  ///< red, green and blue in the whole image
};

/// An integrator held against those paths of bdpt that it can make, at one length.
struct IntegratorFinding {
    IntegratorKind integrator = IntegratorKind::pt;
    int edges = 0;
    MeanComparison whole;
    std::vector<MeanComparison> tiles;
    std::vector<MeanComparison> channels{};
};

/// Merging held against all that find the same paths, at one length.
struct MergeFinding {
    int edges = 0;
    double brought = 0.0;  ///< what merging brings to the image of vcm, on average [nit]
    MeanComparison whole;
    std::vector<MeanComparison> channels{};
};

/// The light of all paths of one length.
struct LengthFinding {
    int edges = 0;
    double radiance = 0.0;  ///< on average over the image, by bdpt [nit]
    double error = 0.0;     ///< its standard error [nit]
    /// The shares that pt, nee and mis can make, and that lt can; in [0, 1].
    double seen_from_camera = 0.0;
    double seen_from_light = 0.0;
};

/// An integrator's mean of the image, over all lengths that are tested.
struct ImageFinding {
    IntegratorKind integrator = IntegratorKind::bdpt;
    double radiance = 0.0;  ///< [nit]
    double error = 0.0;     ///< standard error [nit]
    FilmDefects defects;
    /// The greatest difference of a tile between the image and the sum of the paths that were
    /// reported for it, relative to the tile.
    double lost = 0.0;
};

/// The check of the weights of single paths.
struct WeightFinding {
    std::int64_t paths = 0;
    /// Whose weight differs by more than 0.001 from the definition, by which the weights of all
    /// strategies of a path sum to one.
    std::int64_t wrong = 0;
    double worst = 0.0;  ///< greatest such difference
};

/// The result of `verify`.
struct VerifyReport {
    Verdict verdict = Verdict::inconclusive;
    std::int64_t batches = 0;
    double seconds = 0.0;
    /// The mean of the image [nit].
    double radiance = 0.0;
    /// Errors of a strategy that change the mean of the image by this fraction would have been
    /// found with 90 % chance. Infinite with too few samples to tell.
    double detectable = std::numeric_limits<double>::infinity();
    /// Fraction of the image along paths that only one strategy of bdpt, and neither pt, nee nor
    /// mis, can make: nothing checks it.
    double unchecked = 0.0;
    double false_alarm = 0.0;  ///< that was allowed
    std::vector<PixelRect> tiles;
    std::vector<ImageFinding> images;  ///< bdpt, pt, nee, mis, lt, and vcm if it was asked for
    WeightFinding weights;
    std::vector<LengthFinding> lengths;
    std::vector<StrategyFinding> strategies;
    std::vector<IntegratorFinding> integrators;
    std::vector<MergeFinding> merges;  ///< if vcm was asked for
    /// If merging brought this much too much or too little, as a fraction of what it brings, that
    /// would have been found with 90 % chance. Infinite where nothing else finds what it merges.
    double detectable_of_merging = std::numeric_limits<double>::infinity();
};

/// An error of merging by this fraction has to be detectable, or the verdict is inconclusive.
constexpr double max_error_of_merging = 0.25;

/// Does this comparison fail? Each of the two families of tests, whole images and tiles, has half
/// of the false alarms.
[[nodiscard]] inline bool fails(const MeanComparison& comparison, const VerifyReport& report)
{
    return comparison.p_adjusted <= 0.5 * report.false_alarm;
}

/// Does the image lack what its paths brought, or hold what no path did? Rounding to single
/// floats loses far less.
[[nodiscard]] inline bool loses_light(const ImageFinding& image)
{
    return !(image.lost <= 1e-3);
}

}  // namespace bdpt::eval
