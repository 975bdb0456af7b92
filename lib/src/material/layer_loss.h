#pragma once

#include "material/specular_albedo.h"

#include <array>
#include <cstddef>
#include <functional>
#include <vector>

namespace bdpt {

class FuzzTable;

/// Loss of a white surface below a layer that transmits the fraction min(T(wo), T(wi)) of the light
/// it scatters, where T(w) = 1 - E(w) and E is the layer's albedo: the integral of max(0, E(wi) -
/// E(wo)) f(wo, wi) cos(wi) over wi. For a full layer; it is proportional to the covered fraction
/// of the surface. About 200 kB; refer to it, do not copy it.
class LayerLoss {
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

    /// Returns the albedo of the layer for a cosine.
    using Albedo = std::function<float(float cosine, Roughness roughness)>;

    /// Integrates the tables, which takes some ten milliseconds. `boundary` is that of the surface,
    /// of index 1.5. With `fibres` below the layer, it takes some more.
    LayerLoss(const SpecularAlbedo& boundary, const Albedo& layer,
              const FuzzTable* fibres = nullptr);

    /// Returns the loss of light with this cosine in [0, 1]; `base` is the roughness of the
    /// boundary.
    [[nodiscard]] Directional directional(float cosine, Roughness base,
                                          Roughness layer) const noexcept;
    [[nodiscard]] Average average(Roughness base, Roughness layer) const noexcept;
    /// Loss at fibres below the layer.
    struct AtFibres {
        float reflected = 0.0f;  ///< by white ones, of all light
        float passed = 0.0f;     ///< of diffuse light that has passed them
    };
    /// Requires that there are fibres.
    [[nodiscard]] AtFibres at_fibres(float cosine, Roughness fibres,
                                     Roughness layer) const noexcept;
    /// Returns the cosine-weighted average of g.
    [[nodiscard]] float fresnel_rise() const noexcept { return fresnel_rise_; }

private:
    class Albedos;

    static constexpr int cosine_nodes = 24;
    static constexpr int roughness_nodes = 20;

    [[nodiscard]] static constexpr std::size_t row(std::size_t base, std::size_t layer)
    {
        return base * roughness_nodes + layer;
    }
    template <typename Loss>
    [[nodiscard]] static Loss interpolated(const Loss* table, float cosine, Roughness base,
                                           Roughness layer) noexcept;
    void integrate_boundary(const SpecularAlbedo& boundary, const Albedos& layer);
    void integrate_below(const SpecularAlbedo& boundary, const Albedos& layer);
    void integrate_averages(const SpecularAlbedo& boundary);
    void integrate_fibres(const FuzzTable& fibres, const Albedos& layer);

    float fresnel_rise_;
    /// Rows of roughness of base and layer; within them nodes evenly spaced in sqrt(cosine).
    std::array<Directional, roughness_nodes * roughness_nodes * cosine_nodes> directional_{};
    std::array<Average, roughness_nodes * roughness_nodes> average_{};
    std::vector<AtFibres> at_fibres_;  ///< as `directional_`; empty without fibres
};

}  // namespace bdpt
