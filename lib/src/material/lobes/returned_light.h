#pragma once

#include "material/layer_loss.h"
#include "material/lobes/diffuse.h"
#include "material/specular_albedo.h"
#include "math/elementary.h"
#include "math/rgb.h"

#include <bdpt/types.h>

#include <algorithm>

namespace bdpt {

/// Properties of a base that the layers above need.
struct CoveredBase {
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
    Rgb color{0.0f};     ///< approximate albedo
    float layer = 0.0f;  ///< covered fraction, if the base has a layer itself
};

/// Light that a layer returns to what it covers and that eventually leaves. Like `Interreflection`,
/// it is diffuse, in proportion to the losses without it, of wo and of wi [Kulla and Conty 2017]:
/// reciprocal, and a white base below any layer reflects all light.
class ReturnedLight {
public:
    using Roughness = SpecularAlbedo::Roughness;

    /// Fractions of light from one direction that reach a Lambertian base below the boundary, and
    /// that white microfacets do not reflect at once.
    struct FromBase {
        float transmitted;
        float unreflected;
    };

    ReturnedLight() = default;  ///< no lobe
    /// No lobe yet. `weight` is the covered fraction of the surface, `layer` the roughness of the
    /// layer. `loss` must outlive this.
    ReturnedLight(const CoveredBase& base, float weight, Roughness layer, const LayerLoss& loss)
        : base_(base), loss_(&loss), layer_(layer), weight_(weight)
    {
        // The table uses Fresnel's equations normalised from F0 to F90 for its own index.
        base_.f90 *= base.fresnel_rise / loss.fresnel_rise();
    }

    /// Returns the average fraction that the base alone loses without this lobe.
    [[nodiscard]] float average_lost() const noexcept
    {
        const LayerLoss::Average mean = loss_->average(base_.roughness, layer_);
        const auto [all, f0, f90] = to_base();
        const float below = all * (all * mean.below - f0 * mean.below_f0 - f90 * mean.below_f90) +
                            f0 * f0 * mean.below_f0_f0 + f0 * f90 * mean.below_f0_f90 +
                            f90 * f90 * mean.below_f90_f90;
        const float below_metal = mean.below - mean.below_f0 - mean.below_f90 + mean.below_f0_f0 +
                                  mean.below_f0_f90 + mean.below_f90_f90;
        return weight_ * compute_loss(mean, scattered_again(below_metal), below);
    }
    /// Makes it a lobe: of the lost light, whose average is `average`, the fraction `albedo`
    /// eventually leaves.
    void restore(Rgb albedo, float average) noexcept
    {
        constexpr float min_average = 1e-5f;  // a layer of negligible weight loses nothing
        // The losses are exact within 0.017, those of two layers within 0.03; what they have too
        // much would be made light.
        const float margin = 0.983f - 0.0115f * base_.layer;
        if (average > min_average * weight_) {
            albedo_ = margin * albedo;
            per_coupling_ = inv_pi / average;
        }
    }

    [[nodiscard]] bool exists() const noexcept { return per_coupling_ > 0.0f; }
    /// Returns the largest channel of the fraction of lost light that eventually leaves.
    [[nodiscard]] float weight() const noexcept { return max_component(albedo_); }

    // Fractions of light with this cosine that are lost without this lobe.

    /// Returns what the base alone loses.
    [[nodiscard]] float lost(float cosine, FromBase from) const noexcept
    {
        const LayerLoss::Directional part =
            loss_->directional(std::clamp(cosine, 0.0f, 1.0f), base_.roughness, layer_);
        const float below_metal = part.below - part.below_f0 - part.below_f90;
        const auto [all, f0, f90] = to_base();
        const float below = all * part.below - f0 * part.below_f0 - f90 * part.below_f90;
        return weight_ * compute_loss(part, from.unreflected * scattered_again(below_metal),
                                      from.transmitted * below);
    }
    /// Loss at another layer, between this one and the base.
    struct Between {
        float reflected;  ///< of the light that it reflects
        float thinned;    ///< loss of diffuse light that has passed it, over that without it
    };
    /// For a boundary whose normalised Fresnel's equations have the average `rise`.
    [[nodiscard]] Between at_boundary(float cosine, float f0, float full, float rise,
                                      Roughness roughness, float transmitted_average) const noexcept
    {
        const float f90 = full * rise / loss_->fresnel_rise();
        const LayerLoss::Directional part =
            loss_->directional(std::clamp(cosine, 0.0f, 1.0f), roughness, layer_);
        const float passed = part.below - f0 * part.below_f0 - f90 * part.below_f90;
        return {weight_ * (f0 * part.f0 + f90 * part.f90),
                thinned(cosine,
                        part.below > 0.0f ? passed / (part.below * transmitted_average) : 1.0f)};
    }
    /// For fibres that cover all.
    [[nodiscard]] Between at_fibres(float cosine, Roughness roughness) const noexcept
    {
        const float c = std::clamp(cosine, 0.0f, 1.0f);
        const LayerLoss::AtFibres part = loss_->at_fibres(c, roughness, layer_);
        const float below = loss_->directional(c, {}, layer_).below;
        return {weight_ * part.reflected, thinned(c, below > 0.0f ? part.passed / below : 1.0f)};
    }

    /// Returns the lobe between directions with these losses.
    [[nodiscard]] DiffuseReflection lobe(float lost_o, float lost_i) const noexcept
    {
        return DiffuseReflection(albedo_ * per_coupling_, lost_o * lost_i);
    }

private:
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
    /// Returns the fraction that remains of the base's loss below another layer. `diffuse` is that
    /// of a diffuse base; what a base mirrors stays near one direction, and passes that layer with
    /// nearly the same loss on both ways. The factors are fitted to white furnaces.
    [[nodiscard]] float thinned(float cosine, float diffuse) const
    {
        const float boundary = 0.35f * std::min(1.0f, base_.f90);
        const float mirrors = base_.metallic + (1.0f - base_.metallic) * boundary;
        const float narrow = std::max(0.0f, 1.0f - 1.4f * base_.roughness.value());
        return diffuse + 1.05f * mirrors * narrow * (1.0f - 1.1f * cosine) * (1.0f - diffuse);
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

    CoveredBase base_{};
    const LayerLoss* loss_ = nullptr;
    Roughness layer_{};
    float weight_ = 0.0f;
    Rgb albedo_{0.0f};
    float per_coupling_ = 0.0f;
};

}  // namespace bdpt
