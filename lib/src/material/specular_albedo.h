#pragma once

#include "material/lobes/fresnel.h"
#include "material/refraction_loss.h"
#include "material/table_nodes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace bdpt {

/// Albedo of single scattering by a rough dielectric boundary, for one refractive index: tables
/// over cosine and roughness, in constant time once their rows exist. They are rounded up by at
/// most 0.24 %, so that the diffuse light below the boundary is at most the transmitted light.
/// About 40 kB.
class SpecularAlbedo {
public:
    /// The coefficients of F0 and F90 in an albedo E = F0 f0 + F90 f90.
    struct Split {
        float f0 = 0.0f;
        float f90 = 0.0f;
    };

    /// `ior` is `clamped`.
    explicit SpecularAlbedo(float ior);
    [[nodiscard]] static float clamped(float ior) { return std::clamp(ior, 1.0f, 1e6f); }

    [[nodiscard]] float ior() const noexcept { return ior_; }
    /// Returns the reflectance at normal incidence, ((ior - 1) / (ior + 1))^2.
    [[nodiscard]] float normal_reflectance() const noexcept { return r0_; }

    /// Returns g in F = F0 + (F90 - F0) g: Fresnel's equations normalised from 0 at normal to 1 at
    /// grazing incidence, by the cosine on the side of the lower index.
    [[nodiscard]] float fresnel_course(float cos_outer) const noexcept
    {
        return std::clamp((fresnel_dielectric(cos_outer, ior_) - r0_) * inv_range_, 0.0f, 1.0f);
    }

    /// Returns the loss of refraction at the boundary of a transparent body.
    [[nodiscard]] const RefractionLoss& refraction_loss() const noexcept { return loss_; }

    /// Position of a roughness in tables, evenly spaced in its root: the albedo changes fast where
    /// surfaces are smooth and light grazes them.
    struct Roughness {
        float root = 0.0f;  ///< of the perceptual roughness, in [0, 1]

        /// Returns the perceptual roughness, in [0, 1].
        [[nodiscard]] float value() const { return root * root; }
        /// Returns the position between the rows of a table.
        [[nodiscard]] NodePosition position(int rows) const
        {
            return node_position(root * static_cast<float>(rows - 1), rows);
        }
        /// Returns the roughness of a row.
        [[nodiscard]] static Roughness of_row(std::size_t row, int rows)
        {
            return {static_cast<float>(row) / static_cast<float>(rows - 1)};
        }
    };

    /// Returns the position of a perceptual roughness in [0, 1].
    [[nodiscard]] static Roughness at_roughness(float roughness)
    {
        return {std::sqrt(std::clamp(roughness, 0.0f, 1.0f))};
    }

    /// Returns the albedo for light from a direction with this cosine in [0, 1].
    [[nodiscard]] Split directional(float cosine, Roughness roughness) const noexcept
    {
        const float root = std::clamp(std::sqrt(cosine), 0.0f, 1.0f);
        const NodePosition p = node_position(root * (cosine_nodes - 1), cosine_nodes);
        const NodePosition r = roughness.position(roughness_nodes);
        require(r.node);
        const Split* lower = table_.data() + r.node * cosine_nodes + p.node;
        const Split* upper = lower + cosine_nodes;
        return mix(mix(lower[0], lower[1], p.fraction), mix(upper[0], upper[1], p.fraction),
                   r.fraction);
    }

    /// Returns the cosine-weighted average of `directional` over the hemisphere.
    [[nodiscard]] Split average(Roughness roughness) const noexcept
    {
        const NodePosition r = roughness.position(roughness_nodes);
        require(r.node);
        const Split* row = average_.data() + r.node;
        return mix(row[0], row[1], r.fraction);
    }

private:
    static constexpr int cosine_nodes = 64;
    static constexpr int roughness_nodes = 32;

    [[nodiscard]] static Split mix(Split a, Split b, float t)
    {
        return {a.f0 + t * (b.f0 - a.f0), a.f90 + t * (b.f90 - a.f90)};
    }

    void require(std::size_t node) const noexcept
    {
        rows_.require(node, [this](std::size_t row) { make_row(row); });
    }
    void make_row(std::size_t row) const noexcept;
    [[nodiscard]] Split integrate(float cosine, float roughness) const;
    [[nodiscard]] Split average_of_row(std::size_t row) const;

    float ior_;
    float r0_;
    float inv_range_;  ///< 1 / (1 - r0)
    // Within rows nodes are evenly spaced in sqrt(cosine).
    LazyRows<roughness_nodes> rows_;
    mutable std::array<Split, roughness_nodes * cosine_nodes> table_;
    mutable std::array<Split, roughness_nodes> average_;
    RefractionLoss loss_;
};

/// Albedo of single scattering by white microfacets [Heitz 2014], a table that
/// `make_white_albedo.py` writes: exact within 0.0015, and too small by 0.0005 at most, so that
/// lobes that restore the rest make no light.
class WhiteAlbedo {
public:
    /// Returns the albedo for light from a direction with this cosine in [0, 1]. `roughness` is
    /// perceptual, in [0, 1]; rough, as the albedo of smooth surfaces is 1.
    [[nodiscard]] static float directional(float cosine, float roughness) noexcept
    {
        // Masking matters where the cosine is not much larger than alpha. In this coordinate that
        // region has half of the nodes, however smooth the surface.
        const float root = std::sqrt(cosine);
        const float place = root * (1.0f + roughness) / std::max(root + roughness, 1e-6f);
        const NodePosition p = node_position(place * (cosine_nodes - 1), cosine_nodes);
        const NodePosition r = node_position(roughness * (roughness_nodes - 1), roughness_nodes);
        const float* lower = nodes.data() + r.node * cosine_nodes + p.node;
        const float* upper = lower + cosine_nodes;
        const float below = lower[0] + p.fraction * (lower[1] - lower[0]);
        const float above = upper[0] + p.fraction * (upper[1] - upper[0]);
        return below + r.fraction * (above - below);
    }
    /// Returns the cosine-weighted average of `directional` over the hemisphere.
    [[nodiscard]] static float average(float roughness) noexcept
    {
        const NodePosition r = node_position(roughness * (average_nodes - 1), average_nodes);
        return averages[r.node] + r.fraction * (averages[r.node + 1] - averages[r.node]);
    }

private:
    static constexpr int cosine_nodes = 64;
    static constexpr int roughness_nodes = 32;
    static constexpr int average_nodes = 125;

    static const std::array<float, roughness_nodes * cosine_nodes> nodes;
    static const std::array<float, average_nodes> averages;
};

}  // namespace bdpt
