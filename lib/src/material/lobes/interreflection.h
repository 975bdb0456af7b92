#pragma once

#include "material/lobes/diffuse.h"
#include "material/lobes/fresnel.h"
#include "material/lobes/lobe.h"
#include "math/elementary.h"
#include "math/rgb.h"
#include "math/warp.h"

#include <bdpt/types.h>

#include <algorithm>
#include <cmath>

namespace bdpt {

/// Returns the fraction of light not reflected at once by white microfacets that eventually leaves
/// those with this average reflectance: it is reflected once, repeatedly as microfacets mask it,
/// and leaves. Arguments as in `Interreflection`.
[[nodiscard]] inline Rgb interreflected(float share, Rgb reflectance, float average)
{
    return share * reflectance * reflectance * average /
           (Rgb(1.0f) - reflectance * (1.0f - average));
}

/// Multiple reflection among rough microfacets, of metal above all [Kulla and Conty 2017,
/// "Revisiting Physically Based Shading at Imageworks"]: diffuse light, in proportion to the light
/// that white microfacets do not reflect at once, of wo and of wi. Reciprocal; with a reflectance
/// of 1 both lobes together reflect all light.
class Interreflection {
public:
    /// No lobe.
    Interreflection() = default;
    /// `f0` is the reflectance of the metal at normal incidence, `average` the cosine-weighted
    /// average of the light that white microfacets reflect at once, in [0, 1], `share` the metallic
    /// fraction of the surface.
    Interreflection(Rgb f0, float average, float share)
        : albedo_(interreflected(share, f0 + (1.0f - f0) * mean_schlick_weight, average)),
          per_coupling_(inv_pi / std::max(1.0f - average, min_missing))
    {}

    /// Adds what the rest of the surface returns, by `interreflected`.
    void add(Rgb albedo) { albedo_ += albedo; }

    /// Returns the largest channel of the fraction of light not reflected at once that eventually
    /// leaves.
    [[nodiscard]] float weight() const { return max_component(albedo_); }

    /// Returns the lobe between directions whose light white microfacets leave unreflected in these
    /// fractions.
    [[nodiscard]] DiffuseReflection lobe(float unreflected_o, float unreflected_i) const
    {
        return DiffuseReflection(albedo_ * per_coupling_, unreflected_o * unreflected_i);
    }

private:
    static constexpr float min_missing = 1e-6f;

    Rgb albedo_{0.0f};
    float per_coupling_ = 0.0f;
};

/// Multiple scattering among the microfacets of a transparent body's rough boundary: diffuse light
/// on both sides, in proportion to the losses of single scattering of wo and of wi; after the lobe
/// of Kulla and Conty (2017) for metals. It compensates the whole loss:
///
/// f = n_o^2 M_o(wo) M_i(wi) / (pi (n_1^2 A_1 + n_2^2 A_2))
///
/// for radiance, with the losses M and their averages A of both sides, which is reciprocal [Veach
/// 1997, sec. 5.2].
class RepeatedRefraction {
public:
    /// A side of the boundary: its index, its average loss, and the colour of light transmitted to
    /// it.
    struct Half {
        float index = 1.0f;
        float loss = 0.0f;
    };

    /// `share` is the fraction of light that may pass, `color` the colour of transmitted light. z
    /// is positive on the side of `above`.
    RepeatedRefraction(const Half& above, const Half& below, float share, Rgb color)
        : color_(color),
          index2_above_(above.index * above.index),
          index2_below_(below.index * below.index)
    {
        constexpr float least = 1e-12f;
        const float whole =
            std::max(index2_above_ * above.loss + index2_below_ * below.loss, least);
        per_loss_ = share * inv_pi / whole;
        above_choice_ = index2_above_ * above.loss / whole;
    }

    /// Evaluates the lobe between directions with these losses of single scattering.
    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, float loss_o, float loss_i,
                                TransportMode mode) const noexcept
    {
        const float cos_i = std::abs(wi.z);
        const float index2 = index2_at(mode == TransportMode::radiance ? wo.z : wi.z);
        const Rgb color = same_side(wo, wi) ? Rgb(1.0f) : color_;
        return {color * (per_loss_ * index2 * loss_o * loss_i * cos_i),
                SolidAnglePdf{choice_at(wi.z) * cosine_hemisphere_pdf(cos_i).value},
                SolidAnglePdf{choice_at(wo.z) * cosine_hemisphere_pdf(std::abs(wo.z)).value}};
    }
    [[nodiscard]] std::optional<BsdfSample> sample(float u_side, Vec2 u) const noexcept
    {
        const Vec3 wi = square_to_cosine_hemisphere(u);
        return towards(u_side < above_choice_ ? wi : mirrored(wi));
    }

private:
    [[nodiscard]] float index2_at(float z) const
    {
        return z > 0.0f ? index2_above_ : index2_below_;
    }
    [[nodiscard]] float choice_at(float z) const
    {
        return z > 0.0f ? above_choice_ : 1.0f - above_choice_;
    }

    Rgb color_;
    float index2_above_;
    float index2_below_;
    float per_loss_ = 0.0f;
    float above_choice_ = 0.0f;
};

}  // namespace bdpt
