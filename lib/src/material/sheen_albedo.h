#pragma once

#include <bdpt/types.h>

#include <algorithm>
#include <array>

namespace bdpt {

/// The reflection of fibres that stand off a surface ("Charlie") [Conty Estevez and Kulla 2017,
/// "Production Friendly Microfacet Sheen BRDF"; KHR_materials_sheen], and tables of how much it
/// reflects in all. About 4 kB; refer to it, do not copy it.
class SheenAlbedo {
public:
    /// Perceptual roughness below which fibres do not get straighter: the lobe would be narrower
    /// than anything but luck finds.
    static constexpr float least_roughness = 0.1f;

    /// Integrates the tables, which takes some ten milliseconds.
    SheenAlbedo();

    /// f of white fibres [1/sr]. `wo` and `wi` are above the surface. Never reflects more than it
    /// gets: where the formula does, it is scaled down.
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
    [[nodiscard]] static Rows rows_at(float roughness);
    [[nodiscard]] float scale(Rows rows) const noexcept;

    /// Rows of even roughness from the least one, in them nodes of even sqrt(cosine).
    std::array<float, roughness_nodes * cosine_nodes> table_;
    std::array<float, roughness_nodes> greatest_;  ///< of each row and a little more; at least 1
};

}  // namespace bdpt
