#pragma once

#include "material/lobes/coat_interreflection.h"
#include "material/lobes/lobe.h"
#include "material/specular_albedo.h"
#include "material/tilted_facet.h"
#include "math/frame.h"

#include <optional>

namespace bdpt {

/// A clear varnish around its own normal, +z: a GGX reflection with Fresnel's equations. All
/// directions are above it.
class EvenCoat {
public:
    EvenCoat(float weight, float roughness, const SpecularAlbedo* albedo);

    [[nodiscard]] bool is_delta() const noexcept;
    /// Returns the reflected fraction of light from a direction with this cosine.
    [[nodiscard]] float reflected(float cosine) const noexcept;
    [[nodiscard]] bool exists() const noexcept { return weight_ > 0.0f; }
    /// Returns the light that is reflected back to the base, which has the same normal. The table
    /// must outlive the result.
    [[nodiscard]] CoatInterreflection interreflection(const CoatedBase& base,
                                                      const CoatLoss* loss) const noexcept;

    /// Evaluates the coat: grey, and equal in both modes.
    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept;
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept;

private:
    float weight_;
    float alpha_;
    SpecularAlbedo::Roughness roughness_;
    const SpecularAlbedo* albedo_;
};

/// The clear varnish of KHR_materials_clearcoat, with index 1.5, over a surface whose normal may
/// differ: it is a facet then, like those of normal maps (`MappedBsdf`). Directions are local to
/// the surface below and on the coated side, z > 0.
class Coat {
public:
    /// `weight` in [0, 1] is the coated fraction of the surface. `normal` is unit, with z > 0.
    /// `albedo` is that of index 1.5 and must outlive this; null if no surface is coated.
    Coat(float weight, float roughness, Vec3 normal, const SpecularAlbedo* albedo);

    [[nodiscard]] bool has_smooth_lobe() const noexcept
    {
        return even_.exists() && !even_.is_delta();
    }
    [[nodiscard]] bool is_delta() const noexcept { return even_.is_delta(); }
    /// Returns the fraction of light from `w` that the coat reflects; the base receives at most the
    /// rest.
    [[nodiscard]] float reflected(Vec3 w) const noexcept;
    /// Returns the light that is reflected back to the base: that below an even coat, and less
    /// where the coat is tilted, because less is lost there on average over all azimuths.
    [[nodiscard]] CoatInterreflection interreflection(const CoatedBase& base,
                                                      const CoatLoss* loss) const noexcept;

    /// Evaluates the coat, which is grey.
    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept;
    /// Samples the coat. The densities of delta samples exclude the choice of this lobe.
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept;

private:
    Frame frame_;
    EvenCoat even_;
    TiltedFacet facet_;  ///< local to `frame_`
    bool tilted_;
};

static_assert(Lobe<EvenCoat> && Lobe<Coat>);

/// Applies to a delta sample of the coat the probabilities of choosing the coat from either side.
inline void choose_delta_coat(BsdfSample& sample, float from_choice, float to_choice)
{
    sample.weight /= from_choice;
    sample.pdf_fwd.value *= from_choice;
    sample.pdf_rev.value *= to_choice;
}

}  // namespace bdpt
