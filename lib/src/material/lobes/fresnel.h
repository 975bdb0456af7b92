#pragma once

#include <algorithm>
#include <cmath>

namespace bdpt {

/// Returns the reflectance of a dielectric boundary for unpolarised light, by Fresnel's equations.
/// `cos_outer` in [0, 1] is the cosine on the side of the lower index, `ior` >= 1 the ratio of the
/// indices. It is the same for light from either side.
[[nodiscard]] inline float fresnel_dielectric(float cos_outer, float ior)
{
    // With q = n cos_inner, q^2 = n^2 - 1 + cos_outer^2, which stays precise at grazing angles.
    const float n2 = ior * ior;
    const float q = std::sqrt((ior - 1.0f) * (ior + 1.0f) + cos_outer * cos_outer);
    const float s_sum = cos_outer + q;
    const float p_sum = n2 * cos_outer + q;
    const float both = s_sum * p_sum;
    if (both <= 0.0f) {
        return 0.0f;  // at grazing incidence on no boundary at all (ior 1)
    }
    const float inverse = 1.0f / both;  // one division serves both polarisations
    const float s = (cos_outer - q) * p_sum * inverse;
    const float p = (n2 * cos_outer - q) * s_sum * inverse;
    return 0.5f * (s * s + p * p);
}

/// Returns (1 - cos)^5 [Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering"].
[[nodiscard]] inline float schlick_weight(float cosine)
{
    const float x = std::clamp(1.0f - cosine, 0.0f, 1.0f);
    const float x2 = x * x;
    return x2 * x2 * x;
}
/// Cosine-weighted average of `schlick_weight` over the hemisphere.
inline constexpr float mean_schlick_weight = 1.0f / 21.0f;

}  // namespace bdpt
