#pragma once

#include "material/lobes/lobe.h"
#include "material/lobes/returned_light.h"
#include "material/specular_albedo.h"
#include "material/table_nodes.h"

#include <bdpt/types.h>

#include <array>

namespace bdpt {

/// The reflection of upright fibres on a surface, such as velvet or dust [Zeltner, Burley and
/// Chiang 2022, "Practical Multiple-Scattering Sheen Using Linearly Transformed Cosines"]: for each
/// direction of the eye a linearly transformed cosine, with the rational fits of MaterialX 1.39
/// (mx_zeltner_sheen) to the tables of the paper.
///
/// The paper's lobe is not reciprocal. This one is: the harmonic mean of the lobes of both
/// directions, which is at most twice either, times a factor for each direction that restores the
/// albedo of the paper. About 4 kB; refer to it, do not copy it.
class FuzzTable {
public:
    /// Perceptual roughness to which smaller values are clamped: the lobe would be too narrow.
    static constexpr float min_roughness = 0.1f;

    /// Returns f of white fibres [1/sr]. `wo` and `wi` are above the surface.
    [[nodiscard]] float value(Vec3 wo, Vec3 wi, float roughness) const noexcept
    {
        return eval(wo, wi, roughness).f;
    }
    /// Returns the fraction that white fibres reflect of light with this cosine in [0, 1].
    [[nodiscard]] static float directional(float cosine, float roughness) noexcept;

    /// Returns the position of a roughness in tables of layers of fibres, of which no rows are
    /// below the minimum.
    [[nodiscard]] static SpecularAlbedo::Roughness row(float roughness) noexcept;
    /// Returns the roughness of a row.
    [[nodiscard]] static float roughness_of(SpecularAlbedo::Roughness row) noexcept
    {
        return min_roughness + (1.0f - min_roughness) * row.value();
    }

    /// f, and the densities of the transformed cosines of both directions [1/sr].
    struct Value {
        float f = 0.0f;
        float pdf_fwd = 0.0f;
        float pdf_rev = 0.0f;
    };
    [[nodiscard]] Value eval(Vec3 wo, Vec3 wi, float roughness) const noexcept;
    /// Samples the transformed cosine of `wo`.
    [[nodiscard]] static Vec3 sample(Vec3 wo, float roughness, Vec2 u) noexcept;

private:
    static constexpr int cosine_nodes = 32;
    static constexpr int roughness_nodes = 32;

    void make_row(std::size_t row) const noexcept;
    /// Returns the factor of a direction.
    [[nodiscard]] float scale(NodePosition row, float cosine) const noexcept;

    // Within rows nodes are evenly spaced in sqrt(cosine).
    LazyRows<roughness_nodes> rows_;
    mutable std::array<float, roughness_nodes * cosine_nodes> scale_;
};

/// A layer of fibres [KHR_materials_fuzz, KHR_materials_sheen]. Directions are local and z > 0.
class Fuzz {
public:
    /// `weight`, in [0, 1], is the covered fraction of the surface; `color`, in [0, 1], that of the
    /// fibres. `table` must outlive this; null if no surface has fibres.
    Fuzz(float weight, Rgb color, float roughness, const FuzzTable* table);

    [[nodiscard]] bool exists() const noexcept { return weight_ > 0.0f; }
    [[nodiscard]] bool has_smooth_lobe() const noexcept { return exists(); }
    /// Returns the fraction of light from `w` that does not reach the surface below.
    [[nodiscard]] float reflected(Vec3 w) const noexcept
    {
        return weight_ * FuzzTable::directional(w.z, roughness_);
    }

    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept;
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept;
    [[nodiscard]] bool is_delta() const noexcept { return false; }

    // For `LayerOver`.
    [[nodiscard]] float weight() const noexcept { return weight_; }
    [[nodiscard]] SpecularAlbedo::Roughness row() const noexcept
    {
        return FuzzTable::row(roughness_);
    }
    [[nodiscard]] Rgb color_over(Rgb base) const noexcept;
    void set_base(const CoveredBase&) noexcept {}
    [[nodiscard]] bool filters() const noexcept { return false; }
    [[nodiscard]] float path(Vec3) const noexcept { return 0.0f; }
    [[nodiscard]] Rgb filter(float, bool) const noexcept { return Rgb(1.0f); }
    /// All that would be lost: what is below is scaled by what the fibres do not keep.
    [[nodiscard]] Rgb returned(Rgb base) const noexcept { return base; }
    [[nodiscard]] float lost_below(const ReturnedLight& above, float cosine, float passed,
                                   float lost) const noexcept
    {
        const auto [reflected, thinned] = above.at_fibres(cosine, row());
        return weight_ * reflected + passed * (1.0f + weight_ * (thinned - 1.0f)) * lost;
    }

private:
    Rgb color_;
    float weight_;
    float roughness_;
    const FuzzTable* table_;
};

static_assert(Lobe<Fuzz>);

}  // namespace bdpt
