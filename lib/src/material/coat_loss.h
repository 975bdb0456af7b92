#pragma once

#include "material/specular_albedo.h"

#include <array>
#include <cstddef>

namespace bdpt {

/// Loss of a white surface below a coat that transmits the fraction min(T(wo), T(wi)) of the light
/// it scatters, where T(w) = 1 - E(w) and E is the coat's albedo: the integral of max(0, E(wi) -
/// E(wo)) f(wo, wi) cos(wi) over wi. For a full coat; it is proportional to the coated fraction of
/// the surface. About 120 kB; refer to it, do not copy it.
class CoatLoss {
public:
    using Roughness = SpecularAlbedo::Roughness;

    /// Loss of light from one direction, for the components of the scattering of a surface: a rough
    /// boundary with reflectance F0 (1 - g) + F90 g with the Fresnel curve g of index 1.5, and the
    /// base below it. Each member is to be multiplied by the factors in its name.
    struct Directional {
        float f0 = 0.0f;  ///< reflection of the boundary
        float f90 = 0.0f;
        float below = 0.0f;     ///< a Lambertian surface without boundary
        float below_f0 = 0.0f;  ///< reduction of it by the boundary, in one direction
        float below_f90 = 0.0f;
    };
    /// Cosine-weighted averages of the loss, with a Lambertian surface that receives the light
    /// transmitted by the boundary in both directions: quadratic in F0 and F90.
    struct Average {
        float f0 = 0.0f;
        float f90 = 0.0f;
        float below = 0.0f;
        float below_f0 = 0.0f;
        float below_f90 = 0.0f;
        float below_f0_f0 = 0.0f;
        float below_f0_f90 = 0.0f;
        float below_f90_f90 = 0.0f;
    };

    /// Integrates the tables, which takes some ten milliseconds. `coat` is the albedo of the coat.
    explicit CoatLoss(const SpecularAlbedo& coat);

    /// Returns the loss of light with this cosine in [0, 1]; `base` is the roughness of the
    /// boundary.
    [[nodiscard]] Directional directional(float cosine, Roughness base,
                                          Roughness coat) const noexcept;
    [[nodiscard]] Average average(Roughness base, Roughness coat) const noexcept;
    /// Returns the cosine-weighted average of g.
    [[nodiscard]] float fresnel_rise() const noexcept { return fresnel_rise_; }

private:
    static constexpr int cosine_nodes = 24;
    static constexpr int roughness_nodes = 16;

    [[nodiscard]] static constexpr std::size_t row(std::size_t base, std::size_t coat)
    {
        return base * roughness_nodes + coat;
    }
    void integrate_boundary(const SpecularAlbedo& coat);
    void integrate_below(const SpecularAlbedo& coat);
    void integrate_averages(const SpecularAlbedo& coat);

    float fresnel_rise_;
    /// Rows of evenly spaced roughness of base and coat; within them nodes evenly spaced in
    /// sqrt(cosine).
    std::array<Directional, roughness_nodes * roughness_nodes * cosine_nodes> directional_{};
    std::array<Average, roughness_nodes * roughness_nodes> average_{};
};

}  // namespace bdpt
