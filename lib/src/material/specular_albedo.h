#pragma once

#include "material/fresnel.h"

#include <algorithm>
#include <array>

namespace bdpt {

/// What single scattering by a rough dielectric boundary reflects in all, for one refractive index:
/// tables over cosine and roughness, in constant time. With it the diffuse light below the boundary
/// gets just what the boundary lets through. About 16 kB; refer to it, do not copy it.
class SpecularAlbedo {
public:
    /// The coefficients of F0 and F90 in an albedo E = F0 f0 + F90 f90.
    struct Split {
        float f0 = 0.0f;
        float f90 = 0.0f;
    };

    /// Integrates the tables, which takes some milliseconds. `ior` >= 1.
    explicit SpecularAlbedo(float ior);

    [[nodiscard]] float ior() const noexcept { return ior_; }
    /// Reflectance at normal incidence, ((ior - 1) / (ior + 1))^2.
    [[nodiscard]] float normal_reflectance() const noexcept { return r0_; }

    /// g in F = F0 + (F90 - F0) g: the course of Fresnel's equations from 0 at normal to 1 at
    /// grazing incidence, by the cosine on the side of the lower index.
    [[nodiscard]] float fresnel_course(float cos_outer) const noexcept
    {
        return std::clamp((fresnel_dielectric(cos_outer, ior_) - r0_) * inv_range_, 0.0f, 1.0f);
    }

    /// Of light from a direction with this cosine in [0, 1], for perceptual roughness in [0, 1].
    [[nodiscard]] Split directional(float cosine, float roughness) const noexcept;
    /// The cosine-weighted average of `directional` over the hemisphere.
    [[nodiscard]] Split average(float roughness) const noexcept;

private:
    static constexpr int cosine_nodes = 64;
    static constexpr int roughness_nodes = 32;
    using Row = std::array<Split, cosine_nodes>;

    [[nodiscard]] Split integrate(float cosine, float roughness) const;

    float ior_;
    float r0_;
    float inv_range_;                         ///< 1 / (1 - r0)
    std::array<Row, roughness_nodes> table_;  ///< nodes at even roughness and even sqrt(cosine)
    std::array<Split, roughness_nodes> average_;
};

}  // namespace bdpt
