#pragma once

#include <bdpt/types.h>

#include <cstdint>

namespace bdpt {

/// Returns point i of n that are evenly distributed over the unit square: a Hammersley set, shifted
/// by the random point `u` modulo 1 [Cranley and Patterson 1976, "Randomization of Number Theoretic
/// Methods for Multiple Integration"]. Each is uniform by itself; point 0 is `u`.
[[nodiscard]] inline Vec2 shifted_point(Vec2 u, std::uint32_t i, std::uint32_t n)
{
    std::uint32_t reversed = 0;  // bit-reversed i as a binary fraction
    for (std::uint32_t bits = i, half = 1U << 23U; bits != 0; bits >>= 1U, half >>= 1U) {
        reversed |= (bits & 1U) != 0 ? half : 0U;
    }
    const Vec2 moved(u.x + static_cast<float>(i) / static_cast<float>(n),
                     u.y + static_cast<float>(reversed) * 0x1p-24f);
    return {moved.x < 1.0f ? moved.x : moved.x - 1.0f, moved.y < 1.0f ? moved.y : moved.y - 1.0f};
}

}  // namespace bdpt
