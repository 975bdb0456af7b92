#pragma once

#include <bit>
#include <cstdint>

namespace bdpt {

/// Returns `condition` ? `a` : `b` without a branch.
[[nodiscard]] inline float select(bool condition, float a, float b)
{
    const auto mask = static_cast<std::uint32_t>(-static_cast<std::int32_t>(condition));
    return std::bit_cast<float>((std::bit_cast<std::uint32_t>(a) & mask) |
                                (std::bit_cast<std::uint32_t>(b) & ~mask));
}

}  // namespace bdpt
