#pragma once

#include "material/bsdf_model.h"
#include "material/sheen_albedo.h"

#include <bdpt/types.h>

namespace bdpt {

/// The fibres of KHR_materials_sheen over a surface. Directions are local and z > 0.
class Sheen {
public:
    /// `color` in [0, 1]. `albedo` must outlive this; null where no surface has a sheen.
    Sheen(Rgb color, float roughness, const SheenAlbedo* albedo);

    [[nodiscard]] bool exists() const noexcept { return weight_ > 0.0f; }
    /// The share of light from this cosine that the fibres reflect, in the brightest channel.
    [[nodiscard]] float reflected(float cosine) const noexcept;
    /// The densities are those of directions uniform in the hemisphere.
    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi) const noexcept;
    [[nodiscard]] static Vec3 sample(Vec2 u) noexcept;

private:
    Rgb color_;
    float roughness_;
    float weight_;
    const SheenAlbedo* albedo_;
};

}  // namespace bdpt
