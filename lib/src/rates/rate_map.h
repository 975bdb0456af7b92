#pragma once

#include <bdpt/part/sample_rates.h>

#include <vector>

namespace bdpt {

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
