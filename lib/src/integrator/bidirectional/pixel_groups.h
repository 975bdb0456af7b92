#pragma once

#include "math/sobol.h"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace bdpt {

/// Groups of pixels that take their light paths from the same part of the shared ones. Blocks of
/// 16 x 16 pixels belong to 2^k groups in turn, so that each group is spread over the image; its
/// part is one of 2^k ranges of the bundles of light paths. If the image is rendered group by
/// group, a processor's cache holds the light paths that are needed next.
class PixelGroups {
public:
    static constexpr int block_side = 16;  // [pixels]

    /// A part has at least as many bundles as a block has pixels, which therefore take different
    /// ones: neighbours share no errors. A group has about 16 blocks or more, so that groups are
    /// similar in size whatever the shape of the image.
    PixelGroups(std::int64_t pixels, std::int64_t bundles)
    {
        constexpr std::int64_t least_blocks = 16;
        constexpr std::int64_t block = std::int64_t{block_side} * block_side;
        const std::int64_t most = std::min(bundles, pixels / least_blocks) / block;
        bits_ = most > 1 ? 63 - std::countl_zero(static_cast<std::uint64_t>(most)) : 0;
    }

    [[nodiscard]] std::uint32_t groups() const { return 1U << bits_; }
    [[nodiscard]] std::uint32_t group(int x, int y) const
    {
        return z_order(x, y) >> bits_in_block & (groups() - 1U);
    }

    /// Returns which of `parts` equal parts of the bundles has those of the pixel, whatever its
    /// offset; `parts` is a power of two, at most `groups`.
    [[nodiscard]] std::int64_t part(int x, int y, std::uint32_t seed, std::int64_t parts) const
    {
        return std::int64_t{place(x, y, seed, 0)} * parts >> 32U;
    }

    /// Returns the place of the pixel's bundle among all of them, as a fraction of their number:
    /// the radical inverse of the pixel's index, with an Owen scramble by `seed`. The index is that
    /// along the Z curve, with the group in its lowest bits. Samples of a pixel have different
    /// `offset`s, which are wrapped around the part of the group. Both are in units of 2^-32.
    [[nodiscard]] std::uint32_t place(int x, int y, std::uint32_t seed, std::uint32_t offset) const
    {
        const std::uint32_t z = z_order(x, y);
        const std::uint32_t in_block = z & ((1U << bits_in_block) - 1U);
        const std::uint32_t blocks = z >> bits_in_block >> bits_;
        const std::uint32_t index = (blocks << bits_in_block | in_block) << bits_ | group(x, y);
        const std::uint32_t first = reverse_bits(permute_upwards(index, seed));
        const std::uint32_t within = ~std::uint32_t{0} >> bits_;
        return (first & ~within) | ((first + (offset >> bits_)) & within);
    }

private:
    static constexpr int bits_in_block = 8;

    /// Spreads the bits of `x` to every second bit of the result.
    [[nodiscard]] static constexpr std::uint32_t spread_bits(std::uint32_t x)
    {
        x = (x | x << 8U) & 0x00ff00ffU;
        x = (x | x << 4U) & 0x0f0f0f0fU;
        x = (x | x << 2U) & 0x33333333U;
        return (x | x << 1U) & 0x55555555U;
    }
    /// Returns the index of a pixel along the Z curve [Morton 1966, "A Computer Oriented Geodetic
    /// Data Base"]; films have at most 65536 pixels per side.
    [[nodiscard]] static constexpr std::uint32_t z_order(int x, int y)
    {
        return spread_bits(static_cast<std::uint32_t>(x)) |
               spread_bits(static_cast<std::uint32_t>(y)) << 1U;
    }

    int bits_ = 0;  // of the number of a group
};

/// Selects few of an image's samples at random: those of pixels on a grid, each with the same
/// chance. Samples of other pixels are skipped without a random number.
class SparsePixels {
public:
    /// `share` is the selected fraction of the samples of an image of this size; all pixels are on
    /// the grid unless it is below 1/256.
    SparsePixels(float share, int width, int height) : chance_(share)
    {
        constexpr float max_chance = 1.0f / 64.0f;
        const float all = share * static_cast<float>(width) * static_cast<float>(height);
        const int longest = std::max(width, height);
        for (int stride = 2; all > 0.0f && stride < longest; stride *= 2) {
            const float chance = all / static_cast<float>(count(width, stride)) /
                                 static_cast<float>(count(height, stride));
            if (chance > max_chance) {
                break;
            }
            stride_ = stride;
            chance_ = chance;
        }
    }

    /// Returns the distance of the columns and rows of these pixels.
    [[nodiscard]] int stride() const { return stride_; }
    [[nodiscard]] bool contains(int x, int y) const { return x % stride_ == 0 && y % stride_ == 0; }
    /// Returns the chance that a sample of these pixels is selected.
    [[nodiscard]] float chance() const { return chance_; }

private:
    [[nodiscard]] static int count(int side, int stride) { return (side + stride - 1) / stride; }

    int stride_ = 1;
    float chance_;
};

}  // namespace bdpt
