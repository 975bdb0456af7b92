#pragma once

#include <bdpt/types.h>

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

// Interface of a boundary's film:
// - `bind`: sets F0 of the surface, before all other calls.
// - `over`: the reflectance of film and surface, given the reflectance `bare` of the surface alone
//   and the cosine outside; `f0` is that of the bare surface at normal incidence.
// - `bound`: bounds an albedo that is `bare` without the film, by its coefficients of F0 and F90
//   (`SpecularAlbedo::Split`).
// - `max_albedo_over`: bounds such an albedo by the film's reflectance at its cosine.

/// No film.
struct NoFilm {
    [[nodiscard]] bool exists() const noexcept { return false; }
    void bind(Rgb) noexcept {}
    [[nodiscard]] Rgb over(Rgb bare, Rgb, float) const noexcept { return bare; }
    [[nodiscard]] float bound(float bare, float, float) const noexcept { return bare; }
    [[nodiscard]] float max_albedo_over(float bare, float, Rgb) const noexcept { return bare; }
};

/// A thin film on a surface, whose reflectance is coloured by interference [Belcour and Barla 2017,
/// "A Practical Extension to Microfacet Theory for the Modeling of Varying Iridescence", in the
/// form of KHR_materials_iridescence].
struct ThinFilm {
    float factor = 0.0f;     ///< [0, 1]; 0: no film
    float ior = 1.3f;        ///< >= 1
    float thickness = 0.0f;  ///< [nm]
    float f0_bound = 0.0f;   ///< `greatest` at normal incidence, from `bind`

    [[nodiscard]] bool exists() const noexcept { return factor > 0.0f; }
    void bind(Rgb f0) noexcept { f0_bound = exists() ? greatest(1.0f, f0) : 0.0f; }
    [[nodiscard]] Rgb over(Rgb bare, Rgb f0, float cosine) const noexcept;
    [[nodiscard]] float bound(float bare, float split_f0, float split_f90) const noexcept;
    [[nodiscard]] float max_albedo_over(float bare, float cosine, Rgb f0) const noexcept;

    /// Returns the reflectance of film and surface together, in [0, 1], for the cosine outside.
    /// `f0` is the reflectance of the bare surface at normal incidence.
    [[nodiscard]] Rgb reflectance(float cosine, Rgb f0) const noexcept;
    /// Returns an upper bound of all channels of `reflectance` at this cosine for any thickness; in
    /// [0, 1].
    [[nodiscard]] float greatest(float cosine, Rgb f0) const noexcept;
};

}  // namespace bdpt
