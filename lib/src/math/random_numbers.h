#pragma once

#include "math/rgb.h"

#include <bdpt/types.h>

#include <cstdint>

namespace bdpt {

/// 2^64 over the golden ratio; odd, so its multiples run through all 64-bit numbers.
inline constexpr std::uint64_t golden_ratio_64 = 0x9e3779b97f4a7c15U;

/// Applies the finaliser of SplitMix64 [Steele et al. 2014, "Fast Splittable Pseudorandom Number
/// Generators"]: a pseudorandom permutation of the 64-bit numbers.
[[nodiscard]] constexpr std::uint64_t split_mix(std::uint64_t z)
{
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
    return z ^ (z >> 31U);
}

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

/// Returns point i of n that are evenly distributed over the unit square: a Hammersley set, shifted
/// by the random point `u` modulo 1 [Cranley and Patterson 1976, "Randomization of Number Theoretic
/// Methods for Multiple Integration"]. Each is uniform by itself; point 0 is `u`.
[[nodiscard]] inline Vec2 shifted_point(Vec2 u, std::uint32_t i, std::uint32_t n)
{
    std::uint32_t reversed = 0;  // bit-reversed i as a binary fraction
    for (std::uint32_t bits = i, half = 1U << 23U; bits != 0; bits >>= 1U, half >>= 1U) {
        reversed |= (bits & 1U) != 0 ? half : 0U;
    }
    const Vec2 moved(u.x + static_cast<float>(i) / static_cast<float>(n),
                     u.y + static_cast<float>(reversed) * 0x1p-24f);
    return {moved.x < 1.0f ? moved.x : moved.x - 1.0f, moved.y < 1.0f ? moved.y : moved.y - 1.0f};
}

}  // namespace bdpt
