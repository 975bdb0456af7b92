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

/// Returns the index of a point (bits reversed) in the order of a set, so that the sets of a sample
/// are not correlated. Points are permuted within blocks of 65536, so that most renders need only
/// half of the table: each block is a net by itself.
constexpr std::uint32_t shuffled(std::uint32_t reversed_index, std::uint32_t seed)
{
    constexpr std::uint32_t block = 0xffffU;
    return (permute_upwards(reversed_index, seed) & ~block) | (reversed_index & block);
}

/// Returns the bits of x and y in turns, those of x lower [Morton 1966].
constexpr std::uint32_t interleave(std::uint32_t x, std::uint32_t y)
{
    std::uint64_t bits = std::uint64_t{y} << 32U | x;  // spread in both words
    bits = (bits | bits << 8U) & 0x00ff00ff00ff00ffU;
    bits = (bits | bits << 4U) & 0x0f0f0f0f0f0f0f0fU;
    bits = (bits | bits << 2U) & 0x3333333333333333U;
    bits = (bits | bits << 1U) & 0x5555555555555555U;
    return low_word(bits) | high_word(bits) << 1U;
}

/// A point of a sequence.
struct SequencePoint {
    std::uint64_t place;   ///< of the sequence: a pixel or a square of pixels
    std::uint64_t stream;  ///< which of the sequences of that place
    std::uint32_t index;
};

constexpr std::uint64_t place_at(std::uint32_t x, std::uint32_t y)
{
    return std::uint64_t{y} << 32U | x;
}

/// Returns the point of a sample whose number is not known beforehand.
constexpr SequencePoint open_ended_point(std::uint32_t x, std::uint32_t y, std::uint64_t index)
{
    // Bit 0 selects the half of the film; bits beyond the 32 of a point's index select another
    // sequence.
    constexpr std::uint64_t point_bits = 0x1fffffffeU;
    return {place_at(x, y), index & ~point_bits, low_word((index & point_bits) >> 1U)};
}

/// Returns the point of one of 2^log_samples samples.
constexpr SequencePoint planned_point(std::uint32_t x, std::uint32_t y, std::uint64_t index,
                                      int log_samples)
{
    // Points of one block of 65536 are fast, see `shuffled`.
    const unsigned k = static_cast<unsigned>(log_samples);
    const unsigned side = k < 16 ? (16 - k) / 2 : 0;  // log2 of the square's
    const std::uint32_t in_square = (1U << side) - 1;
    const unsigned of_half = k > 0 ? k - 1 : 0;  // log2 of the samples of a half
    const std::uint64_t number = k > 0 ? index >> 1U : index;
    const std::uint64_t half = k > 0 ? (index & 1U) << of_half : 0;
    constexpr std::uint64_t planned = std::uint64_t{1} << 40U;  // no stream of open-ended points
    return {place_at(x >> side, y >> side), planned | number >> of_half << 5U | k,
            interleave(x & in_square, y & in_square) << k |
                low_word(half | (number & ((std::uint64_t{1} << of_half) - 1)))};
}

}  // namespace

std::uint64_t seed_of_frame(std::uint64_t seed, std::int64_t frame) noexcept
{
    // Mixed twice, so that neither seed and frame nor two frames can cancel out.
    return split_mix(split_mix(seed + golden_ratio_64) ^
                     (static_cast<std::uint64_t>(frame) * golden_ratio_64));
}

Sampler::Sampler(SamplerKind kind, std::uint64_t seed, int x, int y, std::int64_t sample_index,
                 int log_samples)
    : kind_(kind)
{
    const auto column = static_cast<std::uint32_t>(x);
    const auto row = static_cast<std::uint32_t>(y);
    const auto index = static_cast<std::uint64_t>(sample_index);
    SequencePoint point{place_at(column, row), index, 0};
    if (kind == SamplerKind::sobol) {
        point = log_samples == open_ended ? open_ended_point(column, row, index)
                                          : planned_point(column, row, index, log_samples);
        reversed_index_ = reverse_bits(point.index);
    }
    key_ = split_mix(split_mix(split_mix(seed + golden_ratio_64) ^ point.place) +
                     point.stream * golden_ratio_64);
    if (kind == SamplerKind::sobol && log_samples != open_ended) {
        // Sets that share their order would begin with the same points in all pixels of a square.
        reversed_index_ = shuffled(reversed_index_, high_word(split_mix(~key_)));
    }
    segments_ = key_ + split_mix(reversed_index_);
}

float Sampler::ordered_1d(SampleUse use, std::uint32_t vertex) const
{
    const std::uint32_t seed = low_word(bits(first_set(use, vertex), 0));
    // The first coordinate of a Sobol point is its index with reversed bits.
    return to_float(kind_ == SamplerKind::sobol
                        ? reverse_bits(permute_upwards(reverse_bits(reversed_index_), seed))
                        : seed);
}

Vec2 Sampler::ordered_2d(SampleUse use, std::uint32_t vertex) const
{
    const std::uint64_t seeds = bits(first_set(use, vertex), 0);
    if (kind_ != SamplerKind::sobol) {
        return {to_float(low_word(seeds)), to_float(high_word(seeds))};
    }
    const std::uint64_t point = sobol_table.first_pair(reversed_index_);
    return {to_float(reverse_bits(permute_upwards(low_word(point), low_word(seeds)))),
            to_float(reverse_bits(permute_upwards(high_word(point), high_word(seeds))))};
}

[[gnu::always_inline]] inline void Sampler::fill_pair(std::size_t first, std::uint64_t point)
{
    std::uint64_t pair = bits(next_set_ - 1, first / 2);
    if (kind_ == SamplerKind::sobol) {
        // Reversing both words together swaps them.
        pair = reverse_bits(std::uint64_t{permute_upwards(low_word(point), low_word(pair))} << 32U |
                            permute_upwards(high_word(point), high_word(pair)));
    }
    set_[first] = low_word(pair);
    set_[first + 1] = high_word(pair);
}

void Sampler::begin_set()
{
    if (kind_ == SamplerKind::sobol) {
        shuffled_index_ = shuffled(reversed_index_, high_word(bits(next_set_, 2)));
    }
    ++next_set_;
    next_ = 0;
    filled_ = 2;
    fill_pair(0, sobol_table.first_pair(shuffled_index_));
}

void Sampler::fill_second_pair()
{
    filled_ = set_size;
    fill_pair(2, sobol_table.second_pair(shuffled_index_));
}

}  // namespace bdpt
