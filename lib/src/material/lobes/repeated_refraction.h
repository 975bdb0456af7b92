#pragma once

#include "material/lobes/lobe.h"
#include "math/warp.h"

#include <bdpt/types.h>

#include <cmath>
#include <cstdint>

namespace bdpt {

/// What the rough boundary of something transparent scatters more than once among its microfacets:
/// diffuse light on both sides, in proportion to what single scattering loses of wo and of wi;
/// after the lobe of Kulla and Conty (2017) for metals. It fills up all that is lost:
///
///     f = n_o^2 M_o(wo) M_i(wi) / (pi (n_1^2 A_1 + n_2^2 A_2))
///
/// for radiance, with the losses M and their averages A of both sides, which is reciprocal [Veach
/// 1997, sec. 5.2].
class RepeatedRefraction {
public:
    /// A side of the boundary: its index, what it loses on average, and the colour of light that
    /// comes through to it.
    struct Half {
        float index = 1.0f;
        float loss = 0.0f;
    };

    /// `share`: of light that may pass; `color`: of what passes. z is above 0 on the side of
    /// `above`.
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

    /// The lobe between directions of which single scattering loses these shares.
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
