#pragma once

#include <bdpt/part/sample_rates.h>

#include <vector>

namespace bdpt {

/// Values of pixels or cells, row by row from the top left.
using Plane = std::vector<double>;

struct PlaneSize {
    int width;
    int height;
};

/// Returns the mean over a square of (2 radius + 1) x (2 radius + 1) values around each; squares
/// end at the edges.
[[nodiscard]] Plane local_mean(const Plane& plane, PlaneSize size, int radius);
/// Returns that mean with weights, which are not negative; where all are zero, the value itself.
[[nodiscard]] Plane local_mean(const Plane& plane, const Plane& weights, PlaneSize size,
                               int radius);
/// Returns the greatest value of each of those squares.
[[nodiscard]] Plane local_greatest(const Plane& plane, PlaneSize size, int radius);
[[nodiscard]] double mean_of(const Plane& plane);

/// Inclusive range, within that of `SampleRates`.
struct ExponentRange {
    int min = SampleRates::min_exponent;
    int max = SampleRates::max_exponent;
};

/// Returns the logarithm of a value to base 2; of values below 1e-30, and 0, that of 1e-30.
[[nodiscard]] double octaves_of(double value);

inline constexpr int log2_of_steps = 12;
inline constexpr int steps_of_octave = 1 << log2_of_steps;
/// Returns a logarithm in whole steps, plus a part of an octave that differs between neighbouring
/// pixels.
[[nodiscard]] int dithered_step(double octaves, int x, int y);
/// Returns rates by the dithered steps of all pixels, all moved alike and rounded down to octaves.
[[nodiscard]] SampleRates rates_of_steps(PlaneSize size, const std::vector<int>& steps,
                                         ExponentRange range);

/// Returns rates that are on average in proportion to 2^`octaves(x, y)`. Neighbouring pixels round
/// to different powers of two, so that no step is seen where rates change slowly. The mean rate is
/// at most 1, and hardly less unless all have the greatest in `range`.
template <typename Octaves>
[[nodiscard]] SampleRates dithered_rates(PlaneSize size, const Octaves& octaves,
                                         ExponentRange range = {})
{
    std::vector<int> steps;
    steps.reserve(static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height));
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            steps.push_back(dithered_step(octaves(x, y), x, y));
        }
    }
    return rates_of_steps(size, steps, range);
}

/// A pilot's estimates for each pixel of an image, row by row from the top left.
struct RateEvidence {
    int width = 0;   ///< [pixels]
    int height = 0;  ///< [pixels]
    /// Estimated variance of the luminance of one camera sample [nit^2]; not negative.
    std::vector<double> variance{};
    std::vector<double> brightness{};  ///< luminance of the image [nit]; not negative
    std::vector<double> cost{};        ///< cost of one camera sample, in any unit; positive
};

/// Returns the rates with the smallest relMSE for the cost. The error of a pixel is its variance,
/// relative to the local brightness, divided by the number of its samples; so each pixel gets
/// samples in proportion to the root of variance over cost (Neyman's allocation). Their mean is 1,
/// or up to a thousandth less, or less if no rate in range would reach it. All 1 if nothing varies.
[[nodiscard]] SampleRates rates_for(const RateEvidence& evidence);

}  // namespace bdpt
