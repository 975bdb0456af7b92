#pragma once

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

}  // namespace bdpt
