#pragma once

#include <bdpt/part/sample_rates.h>

#include <cstdint>
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
/// Returns the greatest value of each of those squares.
[[nodiscard]] Plane local_greatest(const Plane& plane, PlaneSize size, int radius);
[[nodiscard]] double mean_of(const Plane& plane);

/// Inclusive range, within that of `SampleRates`.
struct ExponentRange {
    int min = SampleRates::min_exponent;
    int max = SampleRates::max_exponent;
};

/// Returns exponents of rates that are in proportion to `wanted`, whose values must be positive.
/// Element i counts `pixels[i]` times, or once if `pixels` is empty. The mean rate is at most 1,
/// and raising one more element would exceed that, unless all have the greatest in `range`.
[[nodiscard]] std::vector<std::int8_t> fitting_exponents(const Plane& wanted,
                                                         const std::vector<std::int64_t>& pixels,
                                                         ExponentRange range = {});

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
