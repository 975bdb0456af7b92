#pragma once

#include "material/specular_albedo.h"

#include <array>
#include <cstddef>

namespace bdpt {

/// What white surfaces lose below a coat that leaves the share min(T(wo), T(wi)) of what they
/// scatter, where T(w) = 1 - E(w) and E is the coat's albedo: the integral of
/// max(0, E(wi) - E(wo)) f(wo, wi) cos(wi) over wi. For a full coat; it is proportional to the
/// share of the surface that is coated. About 120 kB; refer to it, do not copy it.
class CoatLoss {
public:
    using Roughness = SpecularAlbedo::Roughness;

    /// Of light from one direction, for the parts that the scattering of a surface is made of: a
    /// rough boundary whose reflectance is F0 (1 - g) + F90 g with the course g of index 1.5, and
    /// what lies below it. Each is to be multiplied by what its name says.
    struct Directional {
        float f0 = 0.0f;  ///< what the boundary reflects
        float f90 = 0.0f;
        float below = 0.0f;     ///< a Lambertian surface below no boundary
        float below_f0 = 0.0f;  ///< what the boundary keeps from it, in one direction
        float below_f90 = 0.0f;
    };
    /// The cosine-weighted averages of the same, with a Lambertian surface that gets what the
    /// boundary lets through in both directions: quadratic in F0 and F90.
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

    /// Integrates the tables, which takes some ten milliseconds. `coat` is that of the coat.
    explicit CoatLoss(const SpecularAlbedo& coat);

    /// Of light with this cosine in [0, 1]; `base` is the roughness of the boundary.
    [[nodiscard]] Directional directional(float cosine, Roughness base,
                                          Roughness coat) const noexcept;
    [[nodiscard]] Average average(Roughness base, Roughness coat) const noexcept;
    /// The cosine-weighted average of g.
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
    /// Rows of even roughness of base and coat, in them nodes of even sqrt(cosine).
    std::array<Directional, roughness_nodes * roughness_nodes * cosine_nodes> directional_{};
    std::array<Average, roughness_nodes * roughness_nodes> average_{};
};

}  // namespace bdpt
