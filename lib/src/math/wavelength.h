#pragma once

#include <bdpt/types.h>

#include <cstdint>

namespace bdpt {

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

}  // namespace bdpt
