#pragma once

#include "material/coat_loss.h"
#include "material/lobes/diffuse.h"
#include "material/lobes/lobe.h"
#include "material/specular_albedo.h"
#include "material/tilted_facet.h"
#include "math/elementary.h"
#include "math/frame.h"
#include "math/rgb.h"

#include <bdpt/types.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace bdpt {

/// Properties of the base that the coat above needs.
struct CoatedBase {
    float metallic = 0.0f;
    // Reflectance of the dielectric part at normal and at grazing incidence.
    float f0 = 0.0f;
    float f90 = 0.0f;
    /// Fraction of light for which there is a Lambertian base, over the average transmission of the
    /// boundary.
    float diffuse = 0.0f;
    /// Average of the light that white microfacets do not reflect at once.
    float unreflected = 0.0f;
    /// Fraction of such light that the dielectric reflects later, so that it reaches no base; and
    /// the same where the dielectric is opaque.
    float later = 0.0f;
    float opaque_later = 0.0f;
    SpecularAlbedo::Roughness roughness{};
    /// Average of Fresnel's equations normalised from F0 to F90.
    float fresnel_rise = 0.0f;
    Rgb color{0.0f};  ///< approximate albedo
};

/// Light that a coat reflects back to its base and that eventually leaves. Like `Interreflection`,
/// it is diffuse, in proportion to the losses without it, of wo and of wi [Kulla and Conty 2017]:
/// reciprocal, and a white base below any coat reflects all light.
class CoatInterreflection {
public:
    /// Fractions of light from one direction that reach a Lambertian base below the boundary, and
    /// that white microfacets do not reflect at once.
    struct FromBase {
        float transmitted;
        float unreflected;
    };

    CoatInterreflection() = default;  ///< no lobe
    /// `weight` is the coated fraction of the surface, `reflected` the average albedo of a full
    /// coat. `loss` must outlive this.
    CoatInterreflection(const CoatedBase& base, float weight, float reflected,
                        SpecularAlbedo::Roughness coat, const CoatLoss& loss)
        : base_(base), loss_(&loss), coat_(coat), weight_(weight)
    {
        // The table uses Fresnel's equations normalised from F0 to F90 for the coat's index.
        base_.f90 *= base.fresnel_rise / loss.fresnel_rise();
        const CoatLoss::Average mean = loss.average(base_.roughness, coat);
        const auto [all, f0, f90] = to_base();
        const float below = all * (all * mean.below - f0 * mean.below_f0 - f90 * mean.below_f90) +
                            f0 * f0 * mean.below_f0_f0 + f0 * f90 * mean.below_f0_f90 +
                            f90 * f90 * mean.below_f90_f90;
        const float below_metal = mean.below - mean.below_f0 - mean.below_f90 + mean.below_f0_f0 +
                                  mean.below_f0_f90 + mean.below_f90_f90;
        const float average = compute_loss(mean, scattered_again(below_metal), below);
        if (!(average > min_average)) {
            weight_ = 0.0f;  // a coat of negligible weight loses nothing
            return;
        }
        // Light is scattered by the base, reflected by the coat, scattered again, and leaves or is
        // reflected again.
        const float again = weight * reflected;
        albedo_ = base.color * base.color * ((1.0f - again) / (Rgb(1.0f) - base.color * again));
        per_coupling_ = inv_pi / (weight * average);
    }

    /// Returns a lobe that restores this fraction of its light.
    [[nodiscard]] CoatInterreflection times(float fraction) const noexcept
    {
        CoatInterreflection result = *this;
        result.albedo_ *= fraction;
        return result;
    }

    [[nodiscard]] bool exists() const noexcept { return weight_ > 0.0f; }
    /// Returns the largest channel of the fraction of lost light that eventually leaves.
    [[nodiscard]] float weight() const noexcept { return max_component(albedo_); }

    /// Returns the fraction of light with this cosine that is lost without this lobe.
    [[nodiscard]] float lost(float cosine, FromBase from) const noexcept
    {
        const CoatLoss::Directional part =
            loss_->directional(std::clamp(cosine, 0.0f, 1.0f), base_.roughness, coat_);
        const float below_metal = part.below - part.below_f0 - part.below_f90;
        const auto [all, f0, f90] = to_base();
        const float below = all * part.below - f0 * part.below_f0 - f90 * part.below_f90;
        return weight_ * compute_loss(part, from.unreflected * scattered_again(below_metal),
                                      from.transmitted * below);
    }

    /// Returns the lobe between directions with these losses.
    [[nodiscard]] DiffuseReflection lobe(float lost_o, float lost_i) const noexcept
    {
        return DiffuseReflection(albedo_ * per_coupling_, lost_o * lost_i);
    }

private:
    static constexpr float min_average = 1e-5f;

    /// The base receives `all` light less that reflected by a boundary of F0 and F90.
    struct ToBase {
        float all;
        float f0;
        float f90;
    };
    [[nodiscard]] ToBase to_base() const
    {
        return {1.0f - base_.later, base_.f0 - base_.later, base_.f90 - base_.later};
    }
    /// Returns the light that rough metal scatters after more than one reflection.
    [[nodiscard]] float scattered_again(float below_metal) const
    {
        return base_.unreflected > 1e-6f ? below_metal / base_.unreflected : 0.0f;
    }
    template <typename Loss>
    [[nodiscard]] float compute_loss(const Loss& loss, float metal_again, float below) const
    {
        const float metal = loss.f0 + loss.f90 + metal_again;
        const float boundary = base_.f0 * loss.f0 + base_.f90 * loss.f90;
        return std::max(0.0f, base_.metallic * metal + (1.0f - base_.metallic) * boundary +
                                  base_.diffuse * below + base_.opaque_later * metal_again);
    }

    CoatedBase base_{};
    const CoatLoss* loss_ = nullptr;
    SpecularAlbedo::Roughness coat_{};
    float weight_ = 0.0f;
    Rgb albedo_{0.0f};
    float per_coupling_ = 0.0f;
};

/// A clear varnish around its own normal, +z: a GGX reflection with Fresnel's equations. All
/// directions are above it.
class EvenCoat {
public:
    EvenCoat(float weight, float roughness, const SpecularAlbedo* albedo);

    [[nodiscard]] bool is_delta() const noexcept;
    /// Returns the reflected fraction of light from a direction with this cosine.
    [[nodiscard]] float reflected(float cosine) const noexcept;
    [[nodiscard]] bool exists() const noexcept { return weight_ > 0.0f; }
    /// Returns the light that is reflected back to the base, which has the same normal. The table
    /// must outlive the result.
    [[nodiscard]] CoatInterreflection interreflection(const CoatedBase& base,
                                                      const CoatLoss* loss) const noexcept;

    /// Evaluates the coat: grey, and equal in both modes.
    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept;
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept;

private:
    float weight_;
    float alpha_;
    SpecularAlbedo::Roughness roughness_;
    const SpecularAlbedo* albedo_;
};

/// The clear varnish of KHR_materials_clearcoat, with index 1.5, over a surface whose normal may
/// differ: it is a facet then, like those of normal maps (`MappedBsdf`). Directions are local to
/// the surface below and on the coated side, z > 0.
class Coat {
public:
    /// `weight` in [0, 1] is the coated fraction of the surface. `normal` is unit, with z > 0.
    /// `albedo` is that of index 1.5 and must outlive this; null if no surface is coated.
    Coat(float weight, float roughness, Vec3 normal, const SpecularAlbedo* albedo);

    [[nodiscard]] bool has_smooth_lobe() const noexcept
    {
        return even_.exists() && !even_.is_delta();
    }
    [[nodiscard]] bool is_delta() const noexcept { return even_.is_delta(); }
    /// Returns the fraction of light from `w` that the coat reflects; the base receives at most the
    /// rest.
    [[nodiscard]] float reflected(Vec3 w) const noexcept;
    /// Returns the light that is reflected back to the base: that below an even coat, and less
    /// where the coat is tilted, because less is lost there on average over all azimuths.
    [[nodiscard]] CoatInterreflection interreflection(const CoatedBase& base,
                                                      const CoatLoss* loss) const noexcept;

    /// Evaluates the coat, which is grey.
    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept;
    /// Samples the coat. The densities of delta samples exclude the choice of this lobe.
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept;

private:
    Frame frame_;
    EvenCoat even_;
    TiltedFacet facet_;  ///< local to `frame_`
    bool tilted_;
};

static_assert(Lobe<EvenCoat> && Lobe<Coat>);

/// Applies to a delta sample of the coat the probabilities of choosing the coat from either side.
inline void choose_delta_coat(BsdfSample& sample, float from_choice, float to_choice)
{
    sample.weight /= from_choice;
    sample.pdf_fwd.value *= from_choice;
    sample.pdf_rev.value *= to_choice;
}

}  // namespace bdpt
