#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace bdpt {

// The C library selects its variant of these functions by the CPU, and the last bit differs between
// variants. An image must be bit-identical on all machines, so everything that reaches the film
// uses these instead: polynomials in IEEE arithmetic that every CPU rounds alike. Sine, cosine and
// e^x are inline because every walk uses them.

inline constexpr float pi = 3.14159265358979f;
inline constexpr float inv_pi = 0.31830988618379f;

/// Returns the greatest whole number that is not above `x`, whose magnitude is below 2^31. Without
/// SSE 4.1, std::floor is a call of the C library.
[[nodiscard]] inline int floor_to_int(float x)
{
    const int truncated = static_cast<int>(x);
    return truncated - (static_cast<float>(truncated) > x ? 1 : 0);
}

struct SinCos {
    float sin;
    float cos;
};

/// Returns sine and cosine of `r` in [-pi/4, pi/4] [rad].
[[nodiscard]] inline SinCos sin_cos_eighth(float r)
{
    // Taylor series: the first omitted terms are below 2e-9 and 3e-8.
    const float r2 = r * r;
    const float s =
        r + r * r2 * (-1.0f / 6 + r2 * (1.0f / 120 + r2 * (-1.0f / 5040 + r2 * (1.0f / 362880))));
    const float c =
        1.0f - 0.5f * r2 + r2 * r2 * (1.0f / 24 + r2 * (-1.0f / 720 + r2 * (1.0f / 40320)));
    return {s, c};
}

/// Returns sine and cosine of `x` [rad]; absolute error below 1e-6 for |x| <= 1e9. Beyond that,
/// where a float has no digits left for the angle, and for NaN: those of 0.
[[nodiscard]] inline SinCos sin_cos(float x)
{
    constexpr double two_over_pi = 0.63661977236758134308;
    constexpr double half_pi = 1.57079632679489661923;
    if (!(std::abs(x) <= 1e9f)) {
        return {0.0f, 1.0f};
    }
    // Subtracts the nearest multiple of pi/2 in double, so that r keeps full precision.
    const double wide = static_cast<double>(x);
    const auto quadrant = static_cast<std::int32_t>(wide * two_over_pi + std::copysign(0.5, wide));
    const auto r = static_cast<float>(wide - static_cast<double>(quadrant) * half_pi);
    const auto [s, c] = sin_cos_eighth(r);
    const bool odd = (quadrant & 1) != 0;
    const float sine = odd ? c : s;
    const float cosine = odd ? s : c;
    return {(quadrant & 2) != 0 ? -sine : sine, ((quadrant + 1) & 2) != 0 ? -cosine : cosine};
}

/// Returns e^x; relative error below 1e-6; 0 below -87, infinite above 88, NaN for NaN.
[[nodiscard]] inline float exp_exact(float x)
{
    constexpr double inv_ln2 = 1.44269504088896340736;
    constexpr double ln2 = 0.69314718055994530942;
    if (!(x >= -87.0f && x <= 88.0f)) {
        return x < 0.0f ? 0.0f : x + std::numeric_limits<float>::infinity();
    }
    const double wide = static_cast<double>(x);
    const auto k = static_cast<std::int32_t>(wide * inv_ln2 + std::copysign(0.5, wide));
    const auto r = static_cast<float>(wide - static_cast<double>(k) * ln2);
    // Taylor series on |r| <= ln(2)/2; the first omitted term is below 6e-9.
    const float tail =
        1.0f / 6 + r * (1.0f / 24 + r * (1.0f / 120 + r * (1.0f / 720 + r * (1.0f / 5040))));
    const float fraction = 1.0f + r * (1.0f + r * (0.5f + r * tail));
    return fraction * std::bit_cast<float>((k + 127) << 23);
}

/// Returns the angle of the vector (x, y) [rad] in [-pi, pi]; absolute error below 1e-6; 0 for (0,
/// 0).
[[nodiscard]] float atan2_exact(float y, float x);

/// Returns the angle [rad] in [0, pi] of a cosine, which is clamped to [-1, 1]; absolute error
/// below 1e-6.
[[nodiscard]] float acos_exact(float cosine);

/// Returns the natural logarithm of x > 0 (normal floats); absolute error below 1e-6 relative to
/// max(1, |log x|).
[[nodiscard]] float log_exact(float x);

}  // namespace bdpt
