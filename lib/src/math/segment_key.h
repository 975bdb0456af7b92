#pragma once

#include "math/split_mix.h"
#include "math/wavelength.h"

#include <cstdint>

namespace bdpt {

/// Identifies one segment of one sample among all others (`Sampler::segment_key`). The outcome of a
/// ray at surfaces that it may pass is a function of the key and of the surface alone.
struct SegmentKey {
    std::uint64_t value = 0;                    ///< mixed only when a surface needs it
    Wavelength wavelength = Wavelength::green;  ///< wavelength of the sample
    float time = 0.0f;  ///< time of the sample within the shutter interval, in [0, 1]

    /// Returns a key for which the number of every surface is 0: the segment passes no surface that
    /// blocks any light.
    [[nodiscard]] constexpr SegmentKey without_chance() const noexcept
    {
        return {.value = no_chance, .wavelength = wavelength, .time = time};
    }

    /// Tests whether this is no key `without_chance`.
    [[nodiscard]] constexpr bool has_chance() const noexcept { return value != no_chance; }

    /// Returns the number of a surface for this segment: uniform in [0, 1), a multiple of 2^-24.
    [[nodiscard]] constexpr float at_surface(std::uint32_t instance,
                                             std::uint32_t triangle) const noexcept
    {
        if (!has_chance()) [[unlikely]] {
            return 0.0f;
        }
        const std::uint64_t surface = std::uint64_t{instance} << 32U | triangle;
        const std::uint64_t bits = split_mix(split_mix(value) + golden_ratio_64 * surface);
        return static_cast<float>(static_cast<std::int32_t>(bits >> 40U)) * 0x1p-24f;
    }

private:
    static constexpr std::uint64_t no_chance = ~std::uint64_t{0};
};

}  // namespace bdpt
