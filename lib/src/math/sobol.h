#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace bdpt {

/// Coordinates of a point of the four-dimensional Sobol sequence as 32-bit binary fractions, or one
/// number per dimension.
using Sobol4 = std::array<std::uint32_t, 4>;

/// Reverses the order of the bits.
[[nodiscard]] constexpr std::uint32_t reverse_bits(std::uint32_t x)
{
    x = __builtin_bswap32(x);
    x = (x & 0x0f0f0f0fU) << 4U | (x >> 4U & 0x0f0f0f0fU);
    x = (x & 0x33333333U) << 2U | (x >> 2U & 0x33333333U);
    return (x & 0x55555555U) << 1U | (x >> 1U & 0x55555555U);
}

[[nodiscard]] constexpr std::uint64_t reverse_bits(std::uint64_t x)
{
    x = __builtin_bswap64(x);
    x = (x & 0x0f0f0f0f0f0f0f0fU) << 4U | (x >> 4U & 0x0f0f0f0f0f0f0f0fU);
    x = (x & 0x3333333333333333U) << 2U | (x >> 2U & 0x3333333333333333U);
    return (x & 0x5555555555555555U) << 1U | (x >> 1U & 0x5555555555555555U);
}

/// Permutes `x` at random such that each bit depends on lower bits alone: between two bit reversals
/// it is a nested uniform scramble [Owen 1995, "Randomly Permuted (t,m,s)-Nets and
/// (t,s)-Sequences"]. The idea is that of Laine and Karras [2011, "Stratified Sampling for
/// Stochastic Transparency", sec. 3], the use for Sobol points of Burley [2020, "Practical
/// Hash-based Owen Scrambling"], the constants of Vegdahl [2021, "Building a Better LK Hash"].
[[nodiscard]] constexpr std::uint32_t permute_upwards(std::uint32_t x, std::uint32_t seed)
{
    x ^= x * 0x3d20adeaU;
    x += seed;
    x *= (seed >> 16U) | 1U;
    x ^= x * 0x05526c56U;
    x ^= x * 0x53a22864U;
    return x;
}

/// Returns the columns of the generator matrices of the first four dimensions: entry [d][k] is the
/// contribution of bit k of the index to coordinate d. Direction numbers of Joe and Kuo [2008,
/// "Constructing Sobol Sequences with Better Two-Dimensional Projections"].
[[nodiscard]] constexpr std::array<std::array<std::uint32_t, 32>, 4> sobol_columns()
{
    struct Dimension {
        std::size_t degree;                  // degree of the primitive polynomial
        std::uint32_t inner;                 // its coefficients without the first and the last
        std::array<std::uint32_t, 3> first;  // odd, entry k below 2^(k + 1)
    };
    constexpr std::array<Dimension, 3> dimensions{{{1, 0, {1}}, {2, 1, {1, 3}}, {3, 1, {1, 3, 1}}}};
    std::array<std::array<std::uint32_t, 32>, 4> columns{};
    for (std::size_t k = 0; k < 32; ++k) {
        columns[0][k] = 0x80000000U >> k;
    }
    for (std::size_t d = 0; d < dimensions.size(); ++d) {
        const auto [degree, inner, first] = dimensions[d];
        auto& column = columns[d + 1];
        for (std::size_t k = 0; k < 32; ++k) {
            if (k < degree) {
                column[k] = first[k] << (31U - k);
                continue;
            }
            column[k] = column[k - degree] ^ column[k - degree] >> degree;
            for (std::size_t j = 1; j < degree; ++j) {
                column[k] ^= (inner >> (degree - 1 - j) & 1U) * column[k - j];
            }
        }
    }
    return columns;
}

/// Sobol points by table lookup: both the index and the coordinates are bit-reversed, as
/// `permute_upwards` requires. Four bits of the index at a time give four coordinates at once; two
/// kilobytes, which leave the first-level cache to the scene.
class SobolTable {
public:
    constexpr SobolTable()
    {
        constexpr auto columns = sobol_columns();
        for (std::size_t group = 0; group < groups; ++group) {
            for (std::size_t value = 0; value < values; ++value) {
                for (std::size_t d = 0; d < 4; ++d) {
                    for (std::size_t bit = 0; bit < group_bits; ++bit) {
                        const std::size_t index_bit = 31 - (group * group_bits + bit);
                        if ((value >> bit & 1U) != 0) {
                            points_[group][value][d / 2] ^=
                                std::uint64_t{reverse_bits(columns[d][index_bit])} << (d % 2 * 32);
                        }
                    }
                }
            }
        }
    }

    /// Returns coordinates 0 (low word) and 1.
    [[nodiscard]] std::uint64_t first_pair(std::uint32_t reversed_index) const
    {
        return pair(reversed_index, 0);
    }
    /// Returns coordinates 2 (low word) and 3.
    [[nodiscard]] std::uint64_t second_pair(std::uint32_t reversed_index) const
    {
        return pair(reversed_index, 1);
    }
    [[nodiscard]] Sobol4 operator[](std::uint32_t reversed_index) const
    {
        const std::uint64_t first = first_pair(reversed_index);
        const std::uint64_t second = second_pair(reversed_index);
        return {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(first >> 32U),
                static_cast<std::uint32_t>(second), static_cast<std::uint32_t>(second >> 32U)};
    }

private:
    /// Coordinates 0 and 1, and 2 and 3: combined two at a time.
    using Pairs = std::array<std::uint64_t, 2>;

    static constexpr std::size_t group_bits = 4;
    static constexpr std::size_t groups = 32 / group_bits;
    static constexpr std::size_t values = std::size_t{1} << group_bits;

    [[nodiscard]] std::uint64_t pair(std::uint32_t reversed_index, std::size_t which) const
    {
        std::uint64_t sum = add(0, reversed_index, which, groups / 2, groups);
        if (reversed_index % (1U << 16U) != 0) {  // only beyond 65536 points
            sum = add(sum, reversed_index, which, 0, groups / 2);
        }
        return sum;
    }
    [[nodiscard]] std::uint64_t add(std::uint64_t sum, std::uint32_t reversed_index,
                                    std::size_t which, std::size_t first, std::size_t last) const
    {
        for (std::size_t group = first; group < last; ++group) {
            sum ^= points_[group][reversed_index >> (group * group_bits) & (values - 1)][which];
        }
        return sum;
    }

    alignas(64) std::array<std::array<Pairs, values>, groups> points_{};
};

}  // namespace bdpt
