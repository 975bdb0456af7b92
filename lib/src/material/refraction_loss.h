#pragma once

#include <array>

namespace bdpt {

class SpecularAlbedo;

/// Loss of single scattering at the rough boundary of a transparent body: light that is neither
/// reflected nor transmitted, as other microfacets mask it, for one refractive index. About 20 kB;
/// refer to it, do not copy it.
class RefractionLoss {
public:
    /// The side from which light arrives.
    enum class Side { outer, inner };

    /// Integrates the tables, which takes some hundred milliseconds.
    explicit RefractionLoss(const SpecularAlbedo& boundary);

    /// Returns the loss of light with this cosine in [0, 1], in [0, 1]. `f0` and `f90` are the
    /// reflectances at normal and at grazing incidence on the outer side. `roughness` is
    /// perceptual, in [0, 1].
    [[nodiscard]] float directional(Side side, float cosine, float roughness, float f0,
                                    float f90) const noexcept;
    /// Returns the cosine-weighted average of the loss over the hemisphere.
    [[nodiscard]] float average(Side side, float roughness, float f0, float f90) const noexcept;

private:
    static constexpr int cosine_nodes = 32;
    static constexpr int roughness_nodes = 24;

    /// Coefficients of the loss, which is linear in both reflectances.
    struct Loss {
        float none = 0.0f;  ///< loss for zero reflectance
        float per_f0 = 0.0f;
        float per_f90 = 0.0f;
    };
    /// Rows of evenly spaced roughness; within them nodes evenly spaced in sqrt(cosine).
    struct Table {
        std::array<Loss, roughness_nodes * cosine_nodes> directional;
        std::array<Loss, roughness_nodes> average;
    };

    [[nodiscard]] static Loss integrate(const SpecularAlbedo& boundary, Side side, float cosine,
                                        float roughness);
    [[nodiscard]] static Loss compute_average(const Loss* row);
    [[nodiscard]] static Loss mix(const Loss& a, const Loss& b, float t);
    [[nodiscard]] static float value(const Loss& loss, float f0, float f90);
    [[nodiscard]] const Table& table(Side side) const
    {
        return side == Side::outer ? outer_ : inner_;
    }

    Table outer_;
    Table inner_;
};

}  // namespace bdpt
