#pragma once

#include <bdpt/types.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace bdpt {

/// Returns the Rec. 709 luminance.
[[nodiscard]] inline float luminance(Rgb c)
{
    return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
}

[[nodiscard]] inline float max_component(Rgb c)
{
    return std::max(c.r, std::max(c.g, c.b));
}

[[nodiscard]] inline bool is_black(Rgb c)
{
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(c.r) |
                               std::bit_cast<std::uint32_t>(c.g) |
                               std::bit_cast<std::uint32_t>(c.b);
    return bits << 1U == 0;  // all but the signs
}

[[nodiscard]] inline bool is_finite(Rgb c)
{
    return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}

/// The channel whose index of refraction applies, where the index depends on the wavelength: one
/// choice for a whole sample, camera and light paths alike [KHR_materials_dispersion has one index
/// for each channel].
enum class Wavelength : std::uint8_t { red, green, blue };

inline constexpr int wavelengths = 3;

/// Chooses each channel in a third of the samples, from a number that is uniform in [0, 1).
[[nodiscard]] constexpr Wavelength choose_wavelength(float u)
{
    return u < 1.0f / 3.0f   ? Wavelength::red
           : u < 2.0f / 3.0f ? Wavelength::green
                             : Wavelength::blue;
}

/// Returns the weight of a path that has been dispersed: three times its own channel, and none of
/// the others.
[[nodiscard]] inline Rgb spectral_weight(Wavelength wavelength)
{
    Rgb weight(0.0f);
    weight[static_cast<int>(wavelength)] = static_cast<float>(wavelengths);
    return weight;
}

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
