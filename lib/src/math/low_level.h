#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace bdpt {

/// A T with default values, to be copied. Where a larger T is constructed for every vertex, g++
/// would clear it by `rep stos`, whose start-up takes longer than such a copy.
template <typename T>
inline constexpr T blank{};

/// Returns `condition` ? `a` : `b` without a branch.
[[nodiscard]] inline float select(bool condition, float a, float b)
{
    const auto mask = static_cast<std::uint32_t>(-static_cast<std::int32_t>(condition));
    return std::bit_cast<float>((std::bit_cast<std::uint32_t>(a) & mask) |
                                (std::bit_cast<std::uint32_t>(b) & ~mask));
}

/// Four floats with componentwise operators: the vector extension of GCC and Clang. They compile to
/// SIMD instructions, whose results equal those of float.
using Float4 [[gnu::vector_size(16)]] = float;
/// Four integers; comparisons of `Float4` give them, and `mask ? a : b` selects by them.
using Int4 [[gnu::vector_size(16)]] = std::int32_t;

[[nodiscard]] inline Float4 square_root(Float4 x)
{
    return Float4{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3])};
}

/// Returns max(x, 0) of each component.
[[nodiscard]] inline Float4 positive_part(Float4 x)
{
    return x > 0.0f ? x : Float4{};
}

/// Returns the sum of the components.
[[nodiscard]] inline float sum(Float4 x)
{
    return (x[0] + x[1]) + (x[2] + x[3]);
}

}  // namespace bdpt
