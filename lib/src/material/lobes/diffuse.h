#pragma once

#include "material/lobes/lobe.h"
#include "math/warp.h"

#include <cmath>

namespace bdpt {

enum class DiffuseSide { reflected, transmitted };

/// Lambertian scattering to one side, equal from both sides.
template <DiffuseSide to>
class DiffuseLobe {
public:
    /// `f` [1/sr]; `coupling` is the fraction of light that a boundary above transmits, on the way
    /// in and on the way out.
    explicit DiffuseLobe(Rgb f, float coupling = 1.0f) : f_(f), coupling_(coupling) {}

    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode) const noexcept
    {
        if (same_side(wo, wi) != reflects) {
            return {};
        }
        const float cos_i = std::abs(wi.z);
        return {f_ * (coupling_ * cos_i), cosine_hemisphere_pdf(cos_i),
                cosine_hemisphere_pdf(std::abs(wo.z))};
    }
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float, Vec2 u,
                                                   TransportMode) const noexcept
    {
        const Vec3 above = square_to_cosine_hemisphere(u);
        return towards((wo.z > 0.0f) == reflects ? above : mirrored(above));
    }
    [[nodiscard]] bool is_delta() const noexcept { return false; }

private:
    static constexpr bool reflects = to == DiffuseSide::reflected;

    Rgb f_;
    float coupling_;
};

/// Lambertian reflection.
using DiffuseReflection = DiffuseLobe<DiffuseSide::reflected>;

/// Lambertian transmission through a thin surface, such as paper and leaves
/// [KHR_materials_diffuse_transmission].
using DiffuseTransmission = DiffuseLobe<DiffuseSide::transmitted>;

static_assert(Lobe<DiffuseReflection> && Lobe<DiffuseTransmission>);

}  // namespace bdpt
