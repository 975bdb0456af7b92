#pragma once

#include "material/table_nodes.h"
#include "math/elementary.h"

#include <array>
#include <cstddef>
#include <span>

namespace bdpt {

class SpecularAlbedo;

/// Loss of single scattering at the rough boundary of a transparent body: light that is neither
/// reflected nor transmitted, as other microfacets mask it, for one refractive index. About 20 kB.
class RefractionLoss {
public:
    /// The side from which light arrives.
    enum class Side { outer, inner };

    /// `boundary` has the refractive index; it must outlive this.
    explicit RefractionLoss(const SpecularAlbedo& boundary) : boundary_(boundary) {}

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
        LazyRows<roughness_nodes> rows;
        std::array<Loss, roughness_nodes * cosine_nodes> directional;
        std::array<Loss, roughness_nodes> average;
    };

    /// Returns the table with the rows of this node.
    [[nodiscard]] const Table& table(Side side, std::size_t node) const;
    void make_row(Side side, std::size_t row) const;
    [[nodiscard]] Loss integrate(Side side, float cosine, float alpha,
                                 std::span<const SinCos> azimuths) const;
    [[nodiscard]] static Loss compute_average(const Loss* row);
    [[nodiscard]] static Loss mix(const Loss& a, const Loss& b, float t);
    [[nodiscard]] static float value(const Loss& loss, float f0, float f90);

    const SpecularAlbedo& boundary_;
    mutable Table outer_;
    mutable Table inner_;
};

}  // namespace bdpt
