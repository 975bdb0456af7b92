#pragma once

#include <bdpt/types.h>

#include <algorithm>
#include <array>

namespace bdpt {

/// The reflection of fibres that stand off a surface ("Charlie") [Conty Estevez and Kulla 2017,
/// "Production Friendly Microfacet Sheen BRDF"; KHR_materials_sheen], and tables of how much it
/// reflects in all. About 7 kB; refer to it, do not copy it.
class SheenAlbedo {
public:
    /// Perceptual roughness below which fibres do not get straighter: the lobe would be narrower
    /// than anything but luck finds.
    static constexpr float min_roughness = 0.1f;

    /// Integrates the tables, which takes some ten milliseconds.
    SheenAlbedo();

    /// f of white fibres [1/sr]. `wo` and `wi` are above the surface. It is the formula of the
    /// extension, but where that would reflect more light from `wo` or `wi` than arrives, which
    /// it does of grazing light, it is divided by the greater excess of the two.
    [[nodiscard]] float value(Vec3 wo, Vec3 wi, float roughness) const noexcept;

    /// The share that white fibres reflect of light with this cosine in [0, 1].
    [[nodiscard]] float directional(float cosine, float roughness) const noexcept;

private:
    static constexpr int cosine_nodes = 32;
    static constexpr int roughness_nodes = 28;

    /// Where a roughness lies among the rows.
    struct Rows {
        int lower;
        float fraction;
    };
    /// Rows of even roughness from the least one, in them nodes of even sqrt(cosine).
    using Table = std::array<float, roughness_nodes * cosine_nodes>;

    [[nodiscard]] static Rows rows_at(float roughness);
    [[nodiscard]] static float look_up(const Table& table, Rows rows, float cosine) noexcept;
    /// What `value` divides the formula by, >= 1.
    [[nodiscard]] float excess(Rows rows, float cos_o, float cos_i) const noexcept;

    Table directional_;
    Table excess_;  ///< albedo of the formula alone, but at least 1
    std::array<bool, roughness_nodes> exceeds_one_{};  ///< anything of that row
};

}  // namespace bdpt
