#pragma once

#include "math/elementary.h"
#include "math/warp.h"

#include <bdpt/types.h>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace bdpt::ggx {

// The GGX microfacet distribution [Walter et al. 2007, "Microfacet Models for Refraction through
// Rough Surfaces"] with Smith's masking [Heitz 2014, "Understanding the Masking-Shadowing Function
// in Microfacet-Based BRDFs"]. Directions are local; alpha > 0 is one number, or two for x and y.

/// Returns D(h) of a half vector of any length whose square is `length2` > 0. The tilt is computed
/// from x and y: 1 - z^2 would lose all digits for smooth surfaces.
[[nodiscard]] inline float distribution(Vec3 h, float length2, float alpha)
{
    const float alpha2 = alpha * alpha;
    const float spread = (h.x * h.x + h.y * h.y + alpha2 * h.z * h.z) / length2;
    return alpha2 * inv_pi / (spread * spread);
}

[[nodiscard]] inline float distribution(Vec3 h, float length2, Vec2 alpha)
{
    const float product = alpha.x * alpha.y;
    const float tilt = h.x * h.x * (alpha.y / alpha.x) + h.y * h.y * (alpha.x / alpha.y);
    const float spread = (tilt + product * h.z * h.z) / length2;
    return product * inv_pi / (spread * spread);
}

/// Scales x and y by alpha.
[[nodiscard]] inline Vec3 stretched_by(Vec3 w, float alpha)
{
    return {alpha * w.x, alpha * w.y, w.z};
}
[[nodiscard]] inline Vec3 stretched_by(Vec3 w, Vec2 alpha)
{
    return {alpha.x * w.x, alpha.y * w.y, w.z};
}

/// Returns the projected area of the unit-sphere direction stretched by alpha: sqrt(z^2 + alpha^2
/// sin^2). Smith's functions are rational in it: G1 = 2z / (z + stretch).
[[nodiscard]] inline float stretch(Vec3 w, float alpha)
{
    return std::sqrt(w.z * w.z + alpha * alpha * (w.x * w.x + w.y * w.y));
}

[[nodiscard]] inline float stretch(Vec3 w, Vec2 alpha)
{
    const Vec3 stretched = stretched_by(w, alpha);
    return std::sqrt(dot(stretched, stretched));
}

/// Samples a half vector with density G1(wo) D(h) (wo.h) / wo.z, wo.z >= 0 [Heitz 2018, "Sampling
/// the GGX Distribution of Visible Normals"; the spherical cap of Dupuy and Benyoub 2023].
template <typename Alpha>
[[nodiscard]] Vec3 sample_visible_normal(Vec3 wo, Alpha alpha, Vec2 u)
{
    const Vec3 stretched = normalize(stretched_by(wo, alpha));
    const Vec3 cap = square_to_cone(u, 1.0f + stretched.z);
    const Vec3 h = cap + stretched;
    return normalize(stretched_by(Vec3{h.x, h.y, std::max(h.z, 1e-12f)}, alpha));
}

/// A microfacet with the normal h, seen from o, o.z >= 0.
struct Microfacet {
    Vec3 o;
    Vec3 h;
    float cosine;  ///< cosine of the angle between o and h

    [[nodiscard]] Vec3 reflected() const { return 2.0f * cosine * h - o; }
};

/// Samples a microfacet with the density of `sample_visible_normal`.
template <typename Alpha>
[[nodiscard]] Microfacet visible_microfacet(Vec3 o, Alpha alpha, Vec2 u)
{
    const Vec3 h = sample_visible_normal(o, alpha, u);
    return {o, h, std::min(1.0f, dot(o, h))};
}

/// A microfacet lobe without Fresnel factor, with its densities under visible-normal sampling.
struct Lobe {
    float f_cos = 0.0f;      ///< [1/sr]
    float pdf_fwd = 0.0f;    ///< [1/sr]
    float pdf_rev = 0.0f;    ///< [1/sr]
    float cos_outer = 0.0f;  ///< cosine at the microfacet on the side of the lower index
};

/// Evaluates reflection with height-correlated masking; wo.z, wi.z > 0. `cos_outer` is simply wo.h.
template <typename Alpha>
[[nodiscard]] Lobe reflect(Vec3 wo, Vec3 wi, Alpha alpha)
{
    const Vec3 h = wo + wi;
    const float length2 = dot(h, h);
    if (length2 == 0.0f) {
        return {};
    }
    const float half_d = 0.5f * distribution(h, length2, alpha);
    const float stretch_o = stretch(wo, alpha);
    const float stretch_i = stretch(wi, alpha);
    return {half_d * wi.z / (wi.z * stretch_o + wo.z * stretch_i), half_d / (wo.z + stretch_o),
            half_d / (wi.z + stretch_i), std::min(1.0f, 0.5f * std::sqrt(length2))};
}

/// Evaluates refraction between different indices n_o and n_i; wo.z > 0 > wi.z. For importance:
/// radiance has another factor (n_o / n_i)^2. [Walter et al. 2007, eq. 17 and 21]
template <typename Alpha>
[[nodiscard]] Lobe refract(Vec3 wo, Vec3 wi, float n_o, float n_i, Alpha alpha)
{
    const Vec3 sum = n_o * wo + n_i * wi;
    const float length2 = dot(sum, sum);
    if (length2 == 0.0f) {
        return {};
    }
    const Vec3 h = sum * (std::copysign(1.0f, sum.z) / std::sqrt(length2));
    const float cos_o = dot(wo, h);
    const float cos_i = -dot(wi, h);
    if (cos_o <= 0.0f || cos_i <= 0.0f) {
        return {};
    }
    // G1 / z = 2 / (z + stretch), and (n_o wo.h + n_i wi.h)^2 is the squared length of the sum.
    const float visible_o = 2.0f / (wo.z + stretch(wo, alpha));
    const float visible_i = 2.0f / (-wi.z + stretch(wi, alpha));
    const float common = distribution(h, 1.0f, alpha) * cos_o * cos_i / length2;
    const float pdf_fwd = visible_o * common * n_i * n_i;
    return {pdf_fwd * visible_i * -wi.z, pdf_fwd, visible_i * common * n_o * n_o,
            n_o < n_i ? cos_o : cos_i};
}

}  // namespace bdpt::ggx
