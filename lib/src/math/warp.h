#pragma once

#include "math/elementary.h"
#include "math/low_level.h"
#include "math/pdf.h"

#include <bdpt/types.h>

#include <algorithm>
#include <cmath>

namespace bdpt {

// Continuous maps from the unit square, u in [0, 1)^2, and their densities. Directions are around
// +z.

/// Maps to the unit disk uniformly [Shirley and Chiu 1997, "A Low Distortion Map Between Disk and
/// Square"].
[[nodiscard]] inline Vec2 square_to_disk(Vec2 u)
{
    const float a = 2.0f * u.x - 1.0f;
    const float b = 2.0f * u.y - 1.0f;
    // The larger one is random, so this must not be a branch: vectors are selected by masks.
    const float size_a = std::abs(a);
    const float size_b = std::abs(b);
    const Int4 wide =
        Float4{size_a, size_a, size_a, size_a} > Float4{size_b, size_b, size_b, size_b};
    const Float4 ordered = wide ? Float4{a, b} : Float4{b, a};
    const float radius = ordered[0];
    const float divisor = select(radius == 0.0f, 1.0f, radius);
    const SinCos angle = sin_cos_eighth(0.25f * pi * ordered[1] / divisor);
    const float across = radius * angle.cos;
    const float along = radius * angle.sin;
    const Float4 point = wide ? Float4{across, along} : Float4{along, across};
    return {point[0], point[1]};
}

/// Maps to cosine-weighted directions, z >= 0 [Malley's method].
[[nodiscard]] inline Vec3 square_to_cosine_hemisphere(Vec2 u)
{
    const Vec2 p = square_to_disk(u);
    return {p.x, p.y, std::sqrt(std::max(0.0f, 1.0f - p.x * p.x - p.y * p.y))};
}

[[nodiscard]] constexpr SolidAnglePdf cosine_hemisphere_pdf(float cosine)
{
    return {cosine > 0.0f ? cosine * inv_pi : 0.0f};
}

/// Maps to barycentric weights of the first two vertices of a triangle, uniform by area [Heitz
/// 2019, "A Low-Distortion Map Between Triangle and Square"].
[[nodiscard]] inline Vec2 square_to_triangle(Vec2 u)
{
    const float half = 0.5f * std::min(u.x, u.y);
    return {u.x - half, u.y - half};
}

/// Inverts `square_to_triangle`.
[[nodiscard]] inline Vec2 triangle_to_square(Vec2 barycentrics)
{
    const float sum = barycentrics.x + barycentrics.y;
    return barycentrics.y > barycentrics.x ? Vec2{2.0f * barycentrics.x, sum}
                                           : Vec2{sum, 2.0f * barycentrics.y};
}

/// Returns 1 - cos of an angle in [0, pi/2] from the square of its sine, precise for small angles.
[[nodiscard]] inline float one_minus_cos(float sin_squared)
{
    return sin_squared / (1.0f + std::sqrt(std::max(0.0f, 1.0f - sin_squared)));
}

/// Maps uniformly to the cone whose half angle has the given 1 - cos, in (0, 2]: precise for narrow
/// cones; 1 is the hemisphere and 2 the sphere.
[[nodiscard]] inline Vec3 square_to_cone(Vec2 u, float one_minus_cos_max)
{
    const Vec2 p = square_to_disk(u);
    // By Archimedes' theorem 1 - cos is uniform, like r^2 on the disk, and sin^2 = (1 - cos)(1 +
    // cos).
    const float depth = one_minus_cos_max * std::min(1.0f, p.x * p.x + p.y * p.y);
    const float scale = std::sqrt(one_minus_cos_max * (2.0f - depth));
    return {p.x * scale, p.y * scale, 1.0f - depth};
}

[[nodiscard]] constexpr SolidAnglePdf cone_pdf(float one_minus_cos_max)
{
    return {0.5f * inv_pi / one_minus_cos_max};
}

}  // namespace bdpt
