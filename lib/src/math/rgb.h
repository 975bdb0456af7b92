#pragma once

#include <bdpt/types.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace bdpt {

/// Returns the Rec. 709 luminance.
[[nodiscard]] inline float luminance(Rgb c)
{
    return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
}

[[nodiscard]] inline float max_component(Rgb c)
{
    return std::max(c.r, std::max(c.g, c.b));
}

[[nodiscard]] inline bool is_black(Rgb c)
{
    const std::uint32_t bits = std::bit_cast<std::uint32_t>(c.r) |
                               std::bit_cast<std::uint32_t>(c.g) |
                               std::bit_cast<std::uint32_t>(c.b);
    return bits << 1U == 0;  // all but the signs
}

[[nodiscard]] inline bool is_finite(Rgb c)
{
    return std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}

}  // namespace bdpt
