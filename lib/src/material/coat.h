#pragma once

#include "material/bsdf_model.h"
#include "material/specular_albedo.h"
#include "math/frame.h"

#include <optional>

namespace bdpt {

/// The clear varnish of KHR_materials_clearcoat: a GGX reflection with Fresnel's equations of index
/// 1.5 about a normal of its own. Directions are local to the base and on the coated side, z > 0.
class Coat {
public:
    /// `weight` in [0, 1]: the share of the surface that is coated. `normal` is unit. `albedo` is
    /// that of index 1.5 and must outlive this; null where no surface is coated.
    Coat(float weight, float roughness, Vec3 normal, const SpecularAlbedo* albedo);

    [[nodiscard]] bool has_smooth_lobe() const noexcept;
    /// The share of light from `w` that the coat reflects; the base gets no more than the rest.
    [[nodiscard]] float reflected(Vec3 w) const noexcept;

    /// Grey; of a coat that is not perfectly smooth.
    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept;
    [[nodiscard]] std::optional<Vec3> sample(Vec3 wo, Vec2 u) const noexcept;
    /// The reflection of a perfectly smooth coat, which is a delta lobe; the densities are those
    /// before the choice of this lobe.
    [[nodiscard]] std::optional<BsdfSample> mirror(Vec3 wo, TransportMode mode) const noexcept;

private:
    [[nodiscard]] float adjoint(Vec3 wo, Vec3 wi, float cos_o, float cos_i,
                                TransportMode mode) const noexcept;

    Frame frame_;
    float weight_;
    float alpha_;
    SpecularAlbedo::Roughness roughness_;
    const SpecularAlbedo* albedo_;
};

}  // namespace bdpt
