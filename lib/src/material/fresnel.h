#pragma once

#include <algorithm>
#include <cmath>

namespace bdpt {

/// Share of unpolarised light that the boundary of a dielectric reflects, by Fresnel's equations.
/// `cos_outer` in [0, 1] is the cosine on the side of the lower index, `ior` >= 1 the quotient of
/// the indices. It is the same for light from either side.
[[nodiscard]] inline float fresnel_dielectric(float cos_outer, float ior)
{
    const float sin2 = std::max(0.0f, 1.0f - cos_outer * cos_outer);
    const float cos_inner = std::sqrt(std::max(0.0f, 1.0f - sin2 / (ior * ior)));
    const float s_sum = cos_outer + ior * cos_inner;
    const float p_sum = ior * cos_outer + cos_inner;
    if (p_sum <= 0.0f) {
        return 0.0f;  // at grazing incidence on no boundary at all (ior 1)
    }
    const float s = (cos_outer - ior * cos_inner) / s_sum;
    const float p = (ior * cos_outer - cos_inner) / p_sum;
    return 0.5f * (s * s + p * p);
}

/// (1 - cos)^5 [Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering"].
[[nodiscard]] inline float schlick_weight(float cosine)
{
    const float x = std::clamp(1.0f - cosine, 0.0f, 1.0f);
    const float x2 = x * x;
    return x2 * x2 * x;
}

}  // namespace bdpt
