#pragma once

#include "material/lobes/lobe.h"
#include "math/warp.h"

#include <bdpt/types.h>

#include <cmath>
#include <cstdint>

namespace bdpt {

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
