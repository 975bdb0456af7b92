#include "math/elementary.h"

#include <algorithm>

namespace bdpt {

// The coefficients are ours: interpolation at the Chebyshev nodes of the interval, which comes
// within a few per cent of the best polynomial of that degree.

float atan2_exact(float y, float x)
{
    const float abs_x = std::abs(x);
    const float abs_y = std::abs(y);
    const float larger = std::max(abs_x, abs_y);
    if (larger == 0.0f) {
        return 0.0f;
    }
    // atan(t) / t as a polynomial in t^2 on [0, 1]; its own error is 2e-8.
    const float t = std::min(abs_x, abs_y) / larger;
    const float s = t * t;
    const float upper = -0.07456855f + s * (0.04213762f + s * (-0.015731249f + s * 0.0027662835f));
    const float ratio =
        0.99999998f +
        s * (-0.33333037f + s * (0.19991872f + s * (-0.14197798f + s * (0.10618371f + s * upper))));
    const float octant = t * ratio;
    const float quadrant = abs_y > abs_x ? 0.5f * pi - octant : octant;
    return std::copysign(x < 0.0f ? pi - quadrant : quadrant, y);
}

float acos_exact(float cosine)
{
    // acos(c) / sqrt(1 - c) as a polynomial on [0, 1]; its own error is 3e-8.
    const float c = std::min(std::abs(cosine), 1.0f);
    const float upper =
        0.030722122f + c * (-0.016841052f + c * (0.0064915214f + c * -0.0012117378f));
    const float ratio =
        1.5707963f + c * (-0.21459816f + c * (0.08896885f + c * (-0.050114303f + c * upper)));
    const float angle = std::sqrt(1.0f - c) * ratio;
    return cosine < 0.0f ? pi - angle : angle;
}

float log_exact(float x)
{
    constexpr float ln2 = 0.69314718f;
    constexpr std::uint32_t sqrt_half_bits = 0x3f3504f3U;
    // x = m 2^k with m in [sqrt(1/2), sqrt(2)), and log m = 2 artanh((m - 1) / (m + 1)).
    const std::uint32_t offset = std::bit_cast<std::uint32_t>(x) - sqrt_half_bits;
    const std::int32_t k = std::bit_cast<std::int32_t>(offset) >> 23;
    const auto m = std::bit_cast<float>((offset & 0x007fffffU) + sqrt_half_bits);
    const float s = (m - 1.0f) / (m + 1.0f);
    const float s2 = s * s;
    const float tail = s2 * (2.0f / 3 + s2 * (2.0f / 5 + s2 * (2.0f / 7 + s2 * (2.0f / 9))));
    return static_cast<float>(k) * ln2 + (2.0f * s + s * tail);
}

}  // namespace bdpt
