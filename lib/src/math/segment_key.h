#pragma once

#include "math/split_mix.h"
#include "math/wavelength.h"

#include <cstdint>

namespace bdpt {

/// Names one segment of one sample among all others (`Sampler::segment_key`). What happens to a ray
/// on its way, where it may pass surfaces, is a function of the key and of the surface alone.
struct SegmentKey {
    std::uint64_t value = 0;                    ///< mixed only when a surface asks
    Wavelength wavelength = Wavelength::green;  ///< of the whole sample
    float time = 0.0f;  ///< of the whole sample, in [0, 1] while the shutter is open

    /// A key of a segment for which the number of every surface is 0: it passes none that takes any
    /// light away.
    [[nodiscard]] constexpr SegmentKey without_chance() const noexcept
    {
        return {.value = no_chance, .wavelength = wavelength, .time = time};
    }

    /// Uniform in [0, 1), a multiple of 2^-24: the number of a surface for this segment.
    [[nodiscard]] constexpr float at_surface(std::uint32_t instance,
                                             std::uint32_t triangle) const noexcept
    {
        if (value == no_chance) [[unlikely]] {
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
