#pragma once

#include "material/bsdf_model.h"
#include "material/lobes/fresnel.h"
#include "material/small_numbers.h"
#include "material/specular_albedo.h"
#include "math/rgb.h"

#include <bdpt/types.h>

#include <glm/geometric.hpp>

#include <cmath>

namespace bdpt {

/// Reflected and transmitted fractions of light at one microfacet.
struct BoundaryShares {
    Rgb reflected;
    Rgb transmitted;
    float reflect_choice;  ///< probability of reflection; equal from both sides
};

/// The boundary of a dielectric, metal, or a mix of them, optionally under a film: reflectance and
/// transmittance of its microfacets. Shared by the GGX lobes and `SmoothBoundary`. z is positive
/// outside a solid body.
template <typename Film>
struct Boundary {
    /// Replaces the cosine on the outer side to mark total internal reflection.
    static constexpr float total_reflection = -1.0f;

    Rgb base_color{0.0f};  ///< colour of metal, and of transmitted light
    Rgb f0{0.0f};          ///< reflectance of the dielectric at normal incidence
    float f90 = 0.0f;
    float metallic = 0.0f;
    float transmission = 0.0f;  ///< of the dielectric part
    float ior = 1.0f;           ///< index of the inside of a solid body
    bool is_solid = false;
    bool exists = false;  ///< true if it is visible at all
    /// True if the dielectric reflects light that its microfacets mask; metal always does.
    bool interreflects = false;
    PackedPointer<const SpecularAlbedo> albedo{};
    [[no_unique_address]] Film film{};

    [[nodiscard]] bool transmits() const noexcept { return transmission > 0.0f; }
    [[nodiscard]] bool is_inside(float z) const noexcept { return is_solid && z < 0.0f; }
    [[nodiscard]] float index_at(float z) const noexcept { return is_inside(z) ? ior : 1.0f; }

    /// Returns the fraction of light that the dielectric reflects, in the brightest channel.
    [[nodiscard]] float reflected(SpecularAlbedo::Split split) const noexcept
    {
        return film.bound(max_component(f0) * split.f0 + f90 * split.f90, split.f0, split.f90);
    }

    /// Returns the cosine at a microfacet on the side of the lower index, given that on the side of
    /// `z`.
    [[nodiscard]] float cos_outer(float cos_microfacet, float z) const noexcept
    {
        if (!is_inside(z)) {
            return cos_microfacet;
        }
        const float scaled = ior * cos_microfacet;
        const float cos2 = scaled * scaled - (ior - 1.0f) * (ior + 1.0f);
        return cos2 > 0.0f ? std::sqrt(cos2) : total_reflection;
    }

    /// Returns the reflection probability of a microfacet with this cosine on the side of `z`.
    [[nodiscard]] float reflect_choice(float cos_microfacet, float z) const noexcept
    {
        return transmits() ? shares(cos_microfacet, z).reflect_choice : 1.0f;
    }

    /// Returns the fractions of a microfacet with this cosine on the side of `z`.
    [[nodiscard]] BoundaryShares shares(float cos_microfacet, float z) const noexcept
    {
        return shares(cos_outer(cos_microfacet, z), cos_microfacet, z);
    }
    /// Returns the fractions given the cosine on the outer side: it determines the dielectric's
    /// reflectance and all probabilities, so that they are equal in both directions. Metal reflects
    /// by the angle in the medium that it is seen through.
    [[nodiscard]] BoundaryShares shares(float cos_outer, float cos_microfacet,
                                        float z) const noexcept
    {
        const float dielectric = 1.0f - metallic;
        Rgb reflectance{1.0f};
        Rgb reflected{dielectric};
        if (cos_outer != total_reflection) {
            reflectance = f0 + (f90 - f0) * albedo->fresnel_course(cos_outer);
            reflectance = film.over(reflectance, f0, cos_outer);
            reflected = dielectric * reflectance;
        }
        Rgb expected = reflected;  // used for the probability
        if (metallic > 0.0f) {
            expected += metallic * metal(std::max(cos_outer, 0.0f));
            reflected = is_inside(z) ? reflected + metallic * metal(cos_microfacet) : expected;
        }
        if (transmission == 0.0f) {
            return {reflected, Rgb{0.0f}, 1.0f};
        }
        const Rgb transmitted = transmission * base_color * (1.0f - reflectance);
        const float reflected_max = max_component(expected);
        const float sum = reflected_max + max_component(transmitted);
        return {reflected, transmitted, sum > 0.0f ? reflected_max / sum : 1.0f};
    }

private:
    /// Returns the reflectance of metal at this cosine.
    [[nodiscard]] Rgb metal(float cosine) const noexcept
    {
        const Rgb bare = base_color + (1.0f - base_color) * schlick_weight(cosine);
        return film.over(bare, base_color, cosine);
    }
};

/// Refracts `wo` at a microfacet without total reflection; `eta` is the index on wo's side over
/// that on the other.
[[nodiscard]] inline Vec3 refracted(Vec3 wo, Vec3 h, float cos_microfacet, float eta)
{
    const float scaled = eta * cos_microfacet;
    const float cos2_far = (1.0f - eta) * (1.0f + eta) + scaled * scaled;
    return normalize((scaled - std::sqrt(std::max(0.0f, cos2_far))) * h - eta * wo);
}

/// Returns the factor by which radiance is compressed in the denser medium; importance is not
/// [Veach 1997, sec. 5.2].
[[nodiscard]] inline float compression(float n_o, float n_i, TransportMode mode)
{
    return mode == TransportMode::radiance ? n_o * n_o / (n_i * n_i) : 1.0f;
}

}  // namespace bdpt
