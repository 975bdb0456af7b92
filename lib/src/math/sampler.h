#pragma once

#include "math/random_numbers.h"

#include <bdpt/render_options.h>
#include <bdpt/types.h>

#include <array>
#include <cstddef>
#include <cstdint>

namespace bdpt {

/// Purpose of random numbers. Each use at each path vertex has dimensions of its own, so that the
/// consumption of one part of a sample cannot shift another.
enum class SampleUse : std::uint32_t {
    film,         ///< position in the pixel; at a light vertex: pixel that receives its splat
    camera_walk,  ///< scattering at a vertex of the camera subpath
    /// Point on a light for a vertex of the camera subpath. And the choice whether there is one for
    /// the lens (`Sampler::choice_of_visible_light`).
    next_event,
    /// Start of the light subpath: point and choice of the light (0), direction (1). And surfaces
    /// that a ray from the lens may pass (`Sampler::first_crossing`).
    light_start,
    /// Scattering at a vertex of the light subpath. And the choice of connections
    /// (`Sampler::choice_of_connections`).
    light_walk,
    /// Point on the lens: of the camera subpath (0), for a vertex of the light subpath.
    lens,
    ground,  ///< light (even numbers) or direction (odd) for the ground under the scene
    /// Scattering distance in a medium of a camera path (even) or a light path (odd).
    scatter_distance,
    /// A light, and a point in the fog for it, on a segment of the camera path. Only path tracing
    /// uses it: its numbers at a vertex are those of `film` at the next, which only splats use.
    fog,
};

/// Returns the index of number `which` of `count` subsamples of sample `index`. With such indices
/// the subsamples of all samples of one half of the film form one sequence, and those of the other
/// half another.
[[nodiscard]] constexpr std::int64_t subsample_index(std::int64_t index, int count, int which)
{
    return 2 * (index / 2 * count + which) + index % 2;
}

/// Random numbers of one pixel sample, a pure function of (kind, seed, pixel, sample index, use,
/// vertex): equal arguments give equal sequences on every machine and thread. All are multiples of
/// 2^-24 in [0, 1).
///
/// They come in sets of four, each set scrambled and permuted independently ("padding"). The first
/// pair that a use requests has the two best distributed dimensions of its set, so request the most
/// important pair first. Requests beyond the end of a set continue with the first dimensions of
/// another.
///
/// With `SamplerKind::sobol` the numbers of a square of pixels are points of one sequence, if it is
/// known how many samples a pixel takes: each pixel's are consecutive, and pixels follow each other
/// in Z order, so that errors of neighbours cancel out [Ahmed and Wonka 2020, "Screen-space
/// blue-noise diffusion of Monte Carlo sampling error via hierarchical ordering of pixels"]. The
/// scrambling of the index, which depends on its higher bits, is the random order within them.
/// Samples of even index are the first half of the pixel's points, those of odd index the second.
/// If the number is not known, samples of even index of a pixel are one sequence and those of odd
/// index another, independent of it.
class Sampler {
public:
    /// Number of samples that is not known beforehand.
    static constexpr int open_ended = -1;

    /// The vertex of `SampleUse::light_start` whose numbers are those of surfaces that a ray from
    /// the lens may pass, in their order.
    static constexpr std::uint32_t first_crossing = 2;

    /// The vertex of `SampleUse::light_walk` whose number chooses the connections of a camera path,
    /// and its merges.
    static constexpr std::uint32_t choice_of_connections = 0;

    /// The vertex of `SampleUse::next_event` whose number decides whether a point on a light is
    /// connected to the lens.
    static constexpr std::uint32_t choice_of_visible_light = 0;

    /// The pixel takes up to 2^log_samples samples, log_samples in [0, 31]; the same for all pixels
    /// but for those at borders of sampling rates. Further ones are points of other sequences.
    Sampler(SamplerKind kind, std::uint64_t seed, int x, int y, std::int64_t sample_index,
            int log_samples = open_ended);

    /// Continues with the dimensions of a use at a vertex.
    void start(SampleUse use, std::uint32_t vertex = 0)
    {
        next_set_ = first_set(use, vertex);
        next_ = set_size;
    }

    [[nodiscard]] float next_1d() { return to_float(set_[reserve(1)]); }

    [[nodiscard]] Vec2 next_2d()
    {
        const std::size_t first = reserve(2);
        return {to_float(set_[first]), to_float(set_[first + 1])};
    }

    /// Returns a single dimension with 48 bits, in the format of `fine_uniform`: the upper 24 in x,
    /// the lower, which are pure noise, in y.
    [[nodiscard]] Vec2 next_fine()
    {
        const std::size_t at = reserve(1);
        const std::uint64_t lower = bits(next_set_ - 1, fine_hashes + at);
        return {to_float(set_[at]), to_float(static_cast<std::uint32_t>(lower >> 32U))};
    }

    /// Returns a point of a use at a vertex for which `start` is never called. It is cheaper: such
    /// sets have their points in the same order, so estimates from two of them may be added, but a
    /// product of both would be biased.
    [[nodiscard]] Vec2 ordered_2d(SampleUse use, std::uint32_t vertex) const;
    /// Returns its x at a fraction of the cost.
    [[nodiscard]] float ordered_1d(SampleUse use, std::uint32_t vertex) const;

    /// Returns the key of the segment with `s` vertices on the light's side and `t` on the
    /// camera's: (s, t) for a connection, (0, t) where the camera subpath continues from its t
    /// vertices, (s, 0) likewise for the light subpath. Its numbers are independent of those of
    /// other segments and of `next_1d`.
    [[nodiscard, gnu::always_inline]] inline SegmentKey segment_key(int s, int t) const
    {
        // Set numbers have less than 63 bits, so they never equal those of segments.
        const std::uint64_t number = std::uint64_t{1} << 63U |
                                     std::uint64_t{static_cast<std::uint32_t>(s)} << 32U |
                                     static_cast<std::uint32_t>(t);
        return {segments_ + golden_ratio_64 * number};
    }

private:
    static constexpr std::size_t set_size = 4;
    static constexpr std::uint64_t uses = 8;
    static constexpr std::uint64_t sets_per_use = 64;
    static constexpr std::uint64_t hashes_per_set = 8;
    static constexpr std::uint64_t fine_hashes = 4;  ///< first hash for `next_fine`

    [[nodiscard]] static constexpr std::uint64_t first_set(SampleUse use, std::uint32_t vertex)
    {
        return (std::uint64_t{vertex} * uses + static_cast<std::uint64_t>(use)) * sets_per_use;
    }

    /// Converts the upper 24 bits: all floats of that spacing in [0, 1).
    [[nodiscard]] static constexpr float to_float(std::uint32_t bits)
    {
        return static_cast<float>(static_cast<std::int32_t>(bits >> 8U)) * 0x1p-24f;
    }

    /// Returns one of the `hashes_per_set` random words of a set.
    [[nodiscard]] std::uint64_t bits(std::uint64_t set, std::uint64_t number) const
    {
        return split_mix(key_ + golden_ratio_64 * (set * hashes_per_set + number));
    }

    /// Returns the first of `count` unused dimensions in the set.
    [[nodiscard]] std::size_t reserve(std::size_t count)
    {
        if (next_ + count > set_size) {
            begin_set();
        }
        if (next_ + count > filled_) {
            fill_second_pair();
        }
        const std::size_t first = next_;
        next_ += count;
        return first;
    }

    /// Draws the first pair of the next set, which is often all that is needed.
    void begin_set();
    void fill_second_pair();
    /// Computes dimensions `first` and `first` + 1 from coordinates of a point with reversed bits.
    void fill_pair(std::size_t first, std::uint64_t point);

    std::uint64_t key_;
    std::uint64_t segments_;      ///< key of all segments
    std::uint64_t next_set_ = 0;  ///< the current set is the one before
    std::size_t next_ = set_size;
    std::size_t filled_ = 0;            ///< dimensions of the current set that have been drawn
    std::uint32_t shuffled_index_ = 0;  ///< index of the point in the order of the current set
    std::uint32_t reversed_index_ = 0;  ///< bit-reversed index of the point in its sequence
    SamplerKind kind_;
    std::array<std::uint32_t, set_size> set_{};  ///< bits of numbers, see `to_float`
};

}  // namespace bdpt
