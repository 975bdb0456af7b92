#include "math/sampler.h"

#include "math/sobol.h"

namespace bdpt {
namespace {

constexpr SobolTable sobol_table;

constexpr std::uint32_t low_word(std::uint64_t bits)
{
    return static_cast<std::uint32_t>(bits);
}

constexpr std::uint32_t high_word(std::uint64_t bits)
{
    return static_cast<std::uint32_t>(bits >> 32U);
}

/// The index of a point (bits reversed) in the order of a set, so that the sets of a sample are not
/// correlated. Points change places within blocks of 65536, which spares most renders half of the
/// table: each block is a net by itself.
constexpr std::uint32_t shuffled(std::uint32_t reversed_index, std::uint32_t seed)
{
    constexpr std::uint32_t block = 0xffffU;
    return (permute_upwards(reversed_index, seed) & ~block) | (reversed_index & block);
}

}  // namespace

Sampler::Sampler(SamplerKind kind, std::uint64_t seed, int x, int y, std::int64_t sample_index)
    : kind_(kind)
{
    const auto index = static_cast<std::uint64_t>(sample_index);
    const std::uint64_t pixel = static_cast<std::uint64_t>(static_cast<std::uint32_t>(y)) << 32U |
                                static_cast<std::uint32_t>(x);
    std::uint64_t stream = index;
    if (kind == SamplerKind::sobol) {
        // Bit 0 says which half of the film; what the 32 bits of a point's index cannot hold makes
        // another sequence.
        constexpr std::uint64_t point_bits = 0x1fffffffeU;
        reversed_index_ = reverse_bits(low_word((index & point_bits) >> 1U));
        stream = index & ~point_bits;
    }
    key_ =
        split_mix(split_mix(split_mix(seed + golden_ratio_64) ^ pixel) + stream * golden_ratio_64);
}

void Sampler::fill()
{
    const std::uint64_t a = bits(next_set_, 0);
    const std::uint64_t b = bits(next_set_, 1);
    Sobol4 set{low_word(a), high_word(a), low_word(b), high_word(b)};
    if (kind_ == SamplerKind::sobol) {
        const std::uint32_t order = high_word(bits(next_set_, 2));
        const Sobol4 point = sobol_table[shuffled(reversed_index_, order)];
        for (std::size_t d = 0; d < set_size; d += 2) {
            // Two at once; reversed together they change places.
            const std::uint64_t pair =
                reverse_bits(std::uint64_t{permute_upwards(point[d], set[d])} << 32U |
                             permute_upwards(point[d + 1], set[d + 1]));
            set[d] = low_word(pair);
            set[d + 1] = high_word(pair);
        }
    }
    for (std::size_t d = 0; d < set_size; ++d) {
        set_[d] = to_float(set[d]);
    }
    ++next_set_;
    next_ = 0;
}

}  // namespace bdpt
