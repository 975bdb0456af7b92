#pragma once

#include "material/lobes/lobe.h"

#include <bdpt/types.h>

#include <algorithm>
#include <array>

namespace bdpt {

/// The reflection of fibres on a surface ("Charlie") [Conty Estevez and Kulla 2017, "Production
/// Friendly Microfacet Sheen BRDF"; KHR_materials_sheen], and tables of its albedo. About 7 kB;
/// refer to it, do not copy it.
class SheenAlbedo {
public:
    /// Perceptual roughness to which smaller values are clamped: the lobe would be too narrow to
    /// sample.
    static constexpr float min_roughness = 0.1f;

    /// Integrates the tables, which takes about ten milliseconds.
    SheenAlbedo();

    /// Returns f of white fibres [1/sr]. `wo` and `wi` are above the surface. It is the formula of
    /// the extension; where that would reflect more light from `wo` or `wi` than arrives, as at
    /// grazing angles, it is divided by the larger excess of the two.
    [[nodiscard]] float value(Vec3 wo, Vec3 wi, float roughness) const noexcept;

    /// Returns the fraction that white fibres reflect of light with this cosine in [0, 1].
    [[nodiscard]] float directional(float cosine, float roughness) const noexcept;

private:
    static constexpr int cosine_nodes = 32;
    static constexpr int roughness_nodes = 28;

    /// Position of a roughness among the rows.
    struct Rows {
        int lower;
        float fraction;
    };
    /// Rows of evenly spaced roughness from the minimum; within them nodes evenly spaced in
    /// sqrt(cosine).
    using Table = std::array<float, roughness_nodes * cosine_nodes>;

    [[nodiscard]] static Rows rows_at(float roughness);
    [[nodiscard]] static float look_up(const Table& table, Rows rows, float cosine) noexcept;
    /// Returns the divisor of the formula in `value`, >= 1.
    [[nodiscard]] float excess(Rows rows, float cos_o, float cos_i) const noexcept;

    Table directional_;
    Table excess_;                                     ///< albedo of the formula alone, at least 1
    std::array<bool, roughness_nodes> exceeds_one_{};  ///< whether any entry of the row does
};

/// The fibres of KHR_materials_sheen on a surface. Directions are local and z > 0.
class Sheen {
public:
    /// `color` in [0, 1]. `albedo` must outlive this; null if no surface has a sheen.
    Sheen(Rgb color, float roughness, const SheenAlbedo* albedo);

    [[nodiscard]] bool exists() const noexcept { return weight_ > 0.0f; }
    /// Returns the fraction of light from this cosine that the fibres reflect, in the brightest
    /// channel.
    [[nodiscard]] float reflected(float cosine) const noexcept;

    /// Evaluates the sheen. The densities are those of uniform directions in the hemisphere.
    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept;
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept;
    [[nodiscard]] bool is_delta() const noexcept { return false; }

private:
    Rgb color_;
    float roughness_;
    float weight_;
    const SheenAlbedo* albedo_;
};

static_assert(Lobe<Sheen>);

}  // namespace bdpt
