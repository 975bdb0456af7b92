#pragma once

#include <bdpt/types.h>

#include <cmath>
#include <limits>

namespace bdpt {

/// Random choice of the colour channel whose extinction a walk uses to sample its next distance.
/// The probability of a channel is its share of the throughput. The walk divides by the mean of the
/// channels' densities, weighted by these probabilities; then the sum of the throughput's channels
/// does not depend on the distances. This is the balance heuristic over whole walks that use one
/// channel each [Wilkie et al. 2014, "Hero Wavelength Spectral Sampling", sec. 3]. With equal
/// probabilities, the throughput would vary more with each scattering event.
class ChannelChoice {
public:
    /// `beta` is the throughput of the walk, >= 0.
    explicit ChannelChoice(Rgb beta) noexcept
    {
        const float sum = beta.r + beta.g + beta.b;
        if (sum >= std::numeric_limits<float>::min() && std::isfinite(sum)) {
            probabilities_ = beta / sum;
        }
    }

    /// Returns the channel, 0 to 2. `u` is in [0, 1).
    [[nodiscard]] int sample(float u) const noexcept
    {
        // Rounding must not choose a channel without throughput.
        const bool green = u < probabilities_.r + probabilities_.g || probabilities_.b == 0.0f;
        return u < probabilities_.r ? 0 : green ? 1 : 2;
    }
    /// Returns the mean over the channels, weighted by their probabilities.
    [[nodiscard]] float mean(Rgb of_channels) const noexcept
    {
        const Rgb weighted = probabilities_ * of_channels;
        return weighted.r + weighted.g + weighted.b;
    }

private:
    Rgb probabilities_{1.0f / 3.0f};
};

}  // namespace bdpt
