#pragma once

#include <bdpt/part/sample_rates.h>

#include <vector>

namespace bdpt {

/// What a pilot found out about each pixel of an image, row by row from the top left.
struct RateEvidence {
    int width = 0;   ///< [pixels]
    int height = 0;  ///< [pixels]
    /// Of the luminance of one camera sample, estimated [nit^2]; not negative.
    std::vector<double> variance{};
    std::vector<double> brightness{};  ///< luminance of the image [nit]; not negative
    std::vector<double> cost{};        ///< of one camera sample, in any unit; positive
};

/// The rates that leave the least relMSE for the cost. The error of a pixel is its variance,
/// relative to the brightness around, divided by the number of its samples; so each pixel gets them
/// as the root of variance over cost (Neyman's allocation). Their mean is 1, or up to a thousandth
/// less, or less if no rate in range would do. All 1 if nothing varies.
[[nodiscard]] SampleRates rates_for(const RateEvidence& evidence);

}  // namespace bdpt
