#pragma once

#include "material/lobes/lobe.h"
#include "math/elementary.h"
#include "math/rgb.h"
#include "math/warp.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace bdpt {

/// Reflection of a rough diffuse surface, equal from both sides: Oren and Nayar's model with the
/// light that its facets reflect among them [Portsmouth, Kutz and Hill 2025, "EON: A Practical
/// Energy-Preserving Rough Diffuse BRDF"]. Its mean albedo is the colour (the paper's albedo
/// inversion), whatever the roughness.
///
/// Below a boundary, which transmits less at grazing angles, light reaches the facets from other
/// directions, so single reflections bring another share of it: `flattening` is 0 without a
/// boundary, 1 below a smooth one of index 1.5, and in between proportional to how much more is
/// transmitted at normal incidence than on average. With it, a white surface reflects between 99.5
/// and 100.1 % of the light: the lobe is scaled down by what the fit adds at the worst angle.
class RoughDiffuse {
public:
    RoughDiffuse() = default;
    /// `roughness` is in [0, 1], 0: not rough; `coated` is the part below a coat, which is no
    /// boundary of this surface.
    explicit RoughDiffuse(float roughness, float coated = 0.0f)
        : roughness_(roughness),
          single_(1.0f / (1.0f + mean_slope * roughness)),
          kept_(1.0f - 0.004f * roughness * coated)
    {}
    /// Sets the flattening by what a boundary transmits at normal incidence, over its mean.
    void set_boundary(float normal_over_mean)
    {
        flattening_ = (normal_over_mean - 1.0f) / smooth_excess;
        kept_ *= 1.0f - 0.0025f * roughness_ * std::clamp(flattening_, 0.0f, 1.0f);
    }
    [[nodiscard]] bool is_rough() const { return roughness_ > 0.0f; }

    /// Returns f(wo, wi) |cos(wi)| of a surface of this colour, in [0, 1], times `scale`, and the
    /// densities.
    [[nodiscard]] BsdfEval eval(Rgb color, float scale, Vec3 wo, Vec3 wi) const noexcept
    {
        if (!same_side(wo, wi)) {
            return {};
        }
        const float cos_o = std::abs(wo.z);
        const float cos_i = std::abs(wi.z);
        const float s = wo.x * wi.x + wo.y * wi.y;
        const float once =
            single_ * (1.0f + roughness_ * (s > 0.0f ? s / std::max(cos_o, cos_i) : s));
        const float mean = mean_single();
        const float again = missing(cos_o) * missing(cos_i) / (1.0f - mean);
        const Rgb facets = color / (mean + color * (1.0f - mean));
        return {facets * (once + color * again) * (kept_ * scale * inv_pi * cos_i), pdf(wo, wi),
                pdf(wi, wo)};
    }
    /// Samples a direction by the clipped linearly transformed cosines of the paper, sec. 4.
    [[nodiscard]] Vec3 sample(Vec3 wo, float u_lobe, Vec2 u) const noexcept
    {
        const float cosine = std::abs(wo.z);
        const float uniform = uniform_share(cosine);
        Vec3 wi;
        if (u_lobe < uniform) {
            wi = square_to_cone(u, 1.0f);
        } else {
            const Transform to(cosine, roughness_);
            Vec2 disk = square_to_disk(u);
            const float clip = std::sqrt(std::max(0.0f, 1.0f - disk.y * disk.y));
            disk.x = -(clip + to.visible * (disk.x - clip));
            const float z = std::sqrt(std::max(0.0f, 1.0f - dot(disk, disk)));
            const Vec3 local =
                normalize(Vec3(to.a * disk.x + to.b * z, to.c * disk.y, to.d * disk.x + z));
            const Vec2 along = azimuth(wo);
            wi = Vec3(along.x * local.x - along.y * local.y, along.y * local.x + along.x * local.y,
                      local.z);
        }
        return wo.z > 0.0f ? wi : mirrored(wi);
    }

private:
    // Of the model, sec. 2: the mean of its slope term at normal incidence, and over all pairs.
    static constexpr float mean_slope = 0.287793409f;      // 1/2 - 2 / (3 pi)
    static constexpr float mean_reflected = 0.072488212f;  // 2/3 - 28 / (15 pi)
    // Fitted below a smooth boundary of index 1.5.
    static constexpr float smooth_excess = 0.057010243f;
    static constexpr float mean_flattened = -0.011791479f;

    /// The linear transform of cosines, fitted in the paper.
    struct Transform {
        Transform(float cosine, float r)
            : a(1.0f + r * (0.303392f + (0.111709f * cosine - 0.518982f) * cosine +
                            (0.335918f * cosine - 0.276266f) * r)),
              b(r * (1.15859f * cosine - 1.16407f + (0.150815f - 0.150105f * cosine) * r) /
                (cosine * cosine * cosine - 1.43545f)),
              c(1.0f + (0.20013f + (0.261777f * cosine - 0.506373f) * cosine) * r),
              d((0.540852f + (0.475392f * cosine - 1.01625f) * cosine) * r /
                (cosine * (0.0725628f + cosine) - 1.0743f)),
              visible(0.5f + 0.5f / std::sqrt(d * d + 1.0f))
        {}
        float a;
        float b;
        float c;
        float d;
        float visible;  ///< fraction of the cosines above the horizon
    };

    /// Returns the fraction of light from a direction that facets reflect once, over that of a
    /// smooth surface. Polynomials in 1 - cos fit it within 2e-4.
    [[nodiscard]] float reflected_once(float cosine) const
    {
        constexpr std::array slope{0.0f,        0.03482296f, 0.74638066f, -1.32437819f,
                                   1.80582544f, -1.3989563f, 0.42422841f};
        constexpr std::array flattened{
            -2.0405303e-4f, 0.0078460115f, -0.0744180972f, 0.12510555f, -0.134864046f, 0.0f, 0.0f};
        const float x = 1.0f - cosine;
        float sum = 0.0f;
        for (std::size_t i = slope.size(); i-- > 0;) {
            sum = sum * x + slope[i] + flattening_ * flattened[i];
        }
        return single_ * (1.0f + roughness_ * sum);
    }
    [[nodiscard]] float missing(float cosine) const
    {
        return std::max(0.0f, 1.0f - reflected_once(cosine));
    }
    [[nodiscard]] float mean_single() const
    {
        return single_ * (1.0f + roughness_ * (mean_reflected + flattening_ * mean_flattened));
    }
    /// Returns the probability of a uniform direction; the paper has the tenth root.
    [[nodiscard]] float uniform_share(float cosine) const
    {
        return std::sqrt(std::sqrt(std::sqrt(roughness_))) *
               (0.162925f + cosine * (-0.372058f + (0.538233f - 0.290822f * cosine) * cosine));
    }
    /// Returns the azimuth of a direction as a unit vector.
    [[nodiscard]] static Vec2 azimuth(Vec3 w)
    {
        const float length2 = w.x * w.x + w.y * w.y;
        return length2 > 1e-12f ? Vec2(w) / std::sqrt(length2) : Vec2(1.0f, 0.0f);
    }
    [[nodiscard]] SolidAnglePdf pdf(Vec3 wo, Vec3 wi) const
    {
        const float cosine = std::abs(wo.z);
        const float uniform = uniform_share(cosine);
        const Transform to(cosine, roughness_);
        const Vec2 along = azimuth(wo);
        const Vec3 local(along.x * wi.x + along.y * wi.y, along.x * wi.y - along.y * wi.x,
                         std::abs(wi.z));
        const float plane = to.a - to.b * to.d;
        const Vec3 back(to.c * (local.x - to.b * local.z), plane * local.y,
                        to.c * (to.a * local.z - to.d * local.x));
        const float determinant = to.c * plane;
        const float length2 = dot(back, back);
        const float cosines = determinant * determinant * std::max(back.z, 0.0f) * inv_pi /
                              (length2 * length2 * to.visible);
        return SolidAnglePdf{uniform * 0.5f * inv_pi + (1.0f - uniform) * cosines};
    }

    float roughness_ = 0.0f;
    float single_ = 1.0f;  ///< the model's factor of single reflections
    float kept_ = 1.0f;    ///< scales the lobe, so that errors of the fit make no light
    float flattening_ = 0.0f;
};

/// The lobe of a rough diffuse surface of one colour.
class RoughDiffuseReflection {
public:
    /// `coupling` as in `DiffuseReflection`.
    RoughDiffuseReflection(Rgb color, const RoughDiffuse& surface, float coupling = 1.0f)
        : surface_(surface), color_(color), coupling_(coupling)
    {}

    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode) const noexcept
    {
        return surface_.eval(color_, coupling_, wo, wi);
    }
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode) const noexcept
    {
        return towards(surface_.sample(wo, u_lobe, u));
    }
    [[nodiscard]] bool is_delta() const noexcept { return false; }

private:
    RoughDiffuse surface_;
    Rgb color_;
    float coupling_;
};

static_assert(Lobe<RoughDiffuseReflection>);

}  // namespace bdpt
