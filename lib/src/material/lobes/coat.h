#pragma once

#include "material/lobes/coat_interreflection.h"
#include "material/lobes/lobe.h"
#include "material/specular_albedo.h"
#include "material/tilted_facet.h"
#include "math/frame.h"

#include <optional>

namespace bdpt {

/// A clear varnish about its own normal, which is +z: a GGX reflection with Fresnel's equations.
/// All directions are above it.
class EvenCoat {
public:
    EvenCoat(float weight, float roughness, const SpecularAlbedo* albedo);

    [[nodiscard]] bool is_delta() const noexcept;
    /// The share of light from a direction with this cosine that is reflected.
    [[nodiscard]] float reflected(float cosine) const noexcept;
    [[nodiscard]] bool exists() const noexcept { return weight_ > 0.0f; }
    /// What it sends back to the base, which lies even below it. The table must outlive the result.
    [[nodiscard]] CoatInterreflection interreflection(const CoatedBase& base,
                                                      const CoatLoss* loss) const noexcept;

    /// Grey, and the same in both modes.
    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept;
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept;

private:
    float weight_;
    float alpha_;
    SpecularAlbedo::Roughness roughness_;
    const SpecularAlbedo* albedo_;
};

/// The clear varnish of KHR_materials_clearcoat, with index 1.5, over a surface whose normal may be
/// another one: it is a facet then, as those of normal maps (`MappedBsdf`). Directions are local to
/// what lies below and on the coated side, z > 0.
class Coat {
public:
    /// `weight` in [0, 1]: the share of the surface that is coated. `normal` is unit, with z > 0.
    /// `albedo` is that of index 1.5 and must outlive this; null where no surface is coated.
    Coat(float weight, float roughness, Vec3 normal, const SpecularAlbedo* albedo);

    [[nodiscard]] bool has_smooth_lobe() const noexcept
    {
        return even_.exists() && !even_.is_delta();
    }
    [[nodiscard]] bool is_delta() const noexcept { return even_.is_delta(); }
    /// The share of light from `w` that the coat reflects; the base gets no more than the rest.
    [[nodiscard]] float reflected(Vec3 w) const noexcept;
    /// What it sends back to the base; none where it has a normal of its own.
    [[nodiscard]] CoatInterreflection interreflection(const CoatedBase& base,
                                                      const CoatLoss* loss) const noexcept
    {
        return tilted_ ? CoatInterreflection() : even_.interreflection(base, loss);
    }

    /// Grey.
    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept;
    /// The densities of delta samples are those before the choice of this lobe.
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept;

private:
    Frame frame_;
    EvenCoat even_;
    TiltedFacet facet_;  ///< local to `frame_`
    bool tilted_;
};

static_assert(Lobe<EvenCoat> && Lobe<Coat>);

/// A delta sample of the coat, when the coat is chosen with these chances from either side.
inline void choose_delta_coat(BsdfSample& sample, float from_choice, float to_choice)
{
    sample.weight /= from_choice;
    sample.pdf_fwd.value *= from_choice;
    sample.pdf_rev.value *= to_choice;
}

}  // namespace bdpt
