#pragma once

#include <bdpt/types.h>

#include <cmath>
#include <limits>

namespace bdpt {

/// Random choice of the colour channel by whose extinction a walk samples its next distance. Each
/// channel is as probable as its share of the throughput. If the weight of a distance is its
/// transmittance over the mean density of all channels, distances leave the sum of the throughput's
/// channels as it is. The choice equals the balance heuristic over whole walks, each by one channel
/// [Wilkie et al. 2014, "Hero Wavelength Spectral Sampling", sec. 3]. With equal probabilities the
/// throughput would vary more with each scattering.
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
