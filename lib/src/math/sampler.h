#pragma once

#include <bdpt/types.h>

#include <cstdint>

namespace bdpt {

/// What random numbers are for. Each use of each path vertex has dimensions of its own, so that
/// what one part of a sample consumes cannot shift another.
enum class SampleUse : std::uint32_t {
    film,         ///< where in the pixel; at a light vertex: which pixel its splat counts for
    camera_walk,  ///< scattering at a vertex of the camera subpath
    next_event,   ///< a light point for a vertex of the camera subpath
    light_start,  ///< light, point and direction of the light subpath
    light_walk,   ///< scattering at a vertex of the light subpath
};

/// Random numbers of one pixel sample, a pure function of (seed, pixel, sample index, dimension):
/// equal arguments give equal sequences on every machine and thread.
class Sampler {
public:
    Sampler(std::uint64_t seed, int x, int y, std::int64_t sample_index)
        : key_(mix(mix(mix(seed + golden) ^
                       (static_cast<std::uint64_t>(static_cast<std::uint32_t>(y)) << 32U |
                        static_cast<std::uint32_t>(x))) +
                   static_cast<std::uint64_t>(sample_index) * golden))
    {}

    /// Continues with the dimensions of a use at a vertex.
    void start(SampleUse use, std::uint32_t vertex = 0)
    {
        dimension_ = (vertex * uses + static_cast<std::uint32_t>(use)) * dimensions_per_use;
    }

    /// Uniform in [0, 1).
    [[nodiscard]] float next_1d() { return to_float(bits() >> 32U); }

    [[nodiscard]] Vec2 next_2d()
    {
        const std::uint64_t both = bits();
        return {to_float(both >> 32U), to_float(both & 0xffffffffU)};
    }

private:
    static constexpr std::uint32_t uses = 8;
    static constexpr std::uint32_t dimensions_per_use = 4;
    static constexpr std::uint64_t golden = 0x9e3779b97f4a7c15U;  // 2^64 / golden ratio

    /// Finaliser of SplitMix64 [Steele et al. 2014, "Fast Splittable Pseudorandom Number
    /// Generators"].
    [[nodiscard]] static constexpr std::uint64_t mix(std::uint64_t z)
    {
        z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9U;
        z = (z ^ (z >> 27U)) * 0x94d049bb133111ebU;
        return z ^ (z >> 31U);
    }

    /// The upper 24 of 32 bits: all floats of that spacing in [0, 1).
    [[nodiscard]] static constexpr float to_float(std::uint64_t bits32)
    {
        return static_cast<float>(bits32 >> 8U) * 0x1p-24f;
    }

    [[nodiscard]] std::uint64_t bits() { return mix(key_ + golden * ++dimension_); }

    std::uint64_t key_;
    std::uint32_t dimension_ = 0;
};

}  // namespace bdpt
