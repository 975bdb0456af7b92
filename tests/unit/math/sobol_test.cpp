#include "math/sobol.h"

#include "catch.hpp"

#include <vector>

namespace bdpt::sobol_test {
namespace {

constexpr SobolTable table;

Sobol4 point(std::uint32_t index)
{
    Sobol4 result = table[reverse_bits(index)];
    for (std::uint32_t& coordinate : result) {
        coordinate = reverse_bits(coordinate);
    }
    return result;
}

}  // namespace

TEST_CASE("reversing bits puts the last one first", "[sobol]")
{
    CHECK(reverse_bits(1U) == 0x80000000U);
    CHECK(reverse_bits(0x00f0a301U) == 0x80c50f00U);
    for (std::uint32_t k = 0; k < 32; ++k) {
        CHECK(reverse_bits(1U << k) == 0x80000000U >> k);
    }
}

TEST_CASE("the first Sobol points are those of Joe and Kuo's tables", "[sobol]")
{
    // In units of 1/8; their order is that of the Gray code.
    const std::array<Sobol4, 8> published{{{0, 0, 0, 0},
                                           {4, 4, 4, 4},
                                           {6, 2, 2, 2},
                                           {2, 6, 6, 6},
                                           {3, 3, 5, 7},
                                           {7, 7, 1, 3},
                                           {5, 1, 7, 5},
                                           {1, 5, 3, 1}}};
    for (std::uint32_t i = 0; i < 8; ++i) {
        for (std::size_t d = 0; d < 4; ++d) {
            CAPTURE(i, d);
            CHECK(point(i ^ (i >> 1U))[d] == published[i][d] << 29U);
        }
    }
}

TEST_CASE("the table is the generator matrices, for all bits of the index", "[sobol]")
{
    const auto columns = sobol_columns();
    std::uint32_t index = 1;
    for (int trial = 0; trial < 200; ++trial) {
        index = index * 1664525U + 1013904223U;
        Sobol4 expected{};
        for (std::size_t k = 0; k < 32; ++k) {
            for (std::size_t d = 0; d < 4; ++d) {
                expected[d] ^= (index >> k & 1U) * columns[d][k];
            }
        }
        CHECK(point(index) == expected);
    }
}

TEST_CASE("each dimension keeps the bits of the index apart", "[sobol]")
{
    // Column k begins with k zeros and a one: the matrix is triangular, every block of 2^m points
    // has one in each of 2^m intervals.
    for (const auto& columns : sobol_columns()) {
        for (std::size_t k = 0; k < 32; ++k) {
            CHECK((columns[k] << k >> 31U) == 1U);
            CHECK((columns[k] & (0xffffffffU >> k >> 1U)) == 0U);
        }
    }
}

TEST_CASE("the permutation changes bits by those below them only", "[sobol]")
{
    constexpr std::uint32_t bits = 12;
    constexpr std::uint32_t mask = (1U << bits) - 1U;
    for (const std::uint32_t seed : {0U, 1U, 0x9e3779b9U, 0xffffffffU}) {
        std::vector<int> hits(mask + 1);
        for (std::uint32_t x = 0; x <= mask; ++x) {
            const std::uint32_t y = permute_upwards(x, seed);
            ++hits[y & mask];
            REQUIRE((permute_upwards(x | 0xabcd0000U, seed) & mask) == (y & mask));
        }
        CHECK(hits == std::vector<int>(mask + 1, 1));
    }
}

}  // namespace bdpt::sobol_test
