#pragma once

#include "material/lobes/lobe.h"
#include "material/sheen_albedo.h"

#include <bdpt/types.h>

namespace bdpt {

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
