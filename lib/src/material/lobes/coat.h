#pragma once

#include "material/lobes/lobe.h"
#include "material/lobes/returned_light.h"
#include "material/lobes/roughness.h"
#include "material/specular_albedo.h"
#include "material/tilted_facet.h"
#include "math/elementary.h"
#include "math/frame.h"
#include "math/rgb.h"

#include <bdpt/types.h>

#include <optional>

namespace bdpt {

/// A clear varnish around its own normal, +z: a GGX reflection with Fresnel's equations. All
/// directions are above it.
class EvenCoat {
public:
    /// Rougher along x if it is anisotropic.
    EvenCoat(float weight, float roughness, const SpecularAlbedo* albedo, float anisotropy = 0.0f);

    [[nodiscard]] bool is_delta() const noexcept;
    /// Returns the reflected fraction of light from a direction. For an anisotropic coat this is
    /// that of an isotropic one with another alpha: at normal incidence the root mean square of
    /// both, at grazing incidence the alpha along the direction.
    [[nodiscard]] float reflected(Vec3 w) const noexcept;
    [[nodiscard]] bool exists() const noexcept { return weight_ > 0.0f; }
    /// Returns the average of `reflected`.
    [[nodiscard]] float average() const noexcept;
    [[nodiscard]] float weight() const noexcept { return weight_; }
    [[nodiscard]] SpecularAlbedo::Roughness row() const noexcept { return row_; }
    /// Requires that it exists.
    [[nodiscard]] const SpecularAlbedo& albedo() const noexcept { return *albedo_; }

    /// Evaluates the coat: grey, and equal in both modes.
    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept;
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept;

private:
    float weight_;
    Vec2 alpha_;
    SpecularAlbedo::Roughness row_;  ///< of the root mean square of alpha
    const SpecularAlbedo* albedo_;
};

/// What a coat is besides varnish.
struct CoatLook {
    Rgb color{1.0f};         ///< of light that passes straight through and back
    float darkening = 0.0f;  ///< share of the darkening of the base by light reflected inside
    float anisotropy = 0.0f;
    Vec3 along{1.0f, 0.0f, 0.0f};  ///< rougher direction, in the surface
};

/// A coat [KHR_materials_clearcoat, KHR_materials_coat] over a surface whose normal may differ: it
/// is a facet then, like those of normal maps (`MappedBsdf`). Directions are local to the surface
/// below and on the coated side, z > 0.
class Coat {
public:
    /// `weight` in [0, 1] is the coated fraction of the surface. `normal` is unit, with z > 0.
    /// `albedo`, which has the index, must outlive this; null if the surface is not coated.
    Coat(float weight, float roughness, Vec3 normal, const SpecularAlbedo* albedo,
         const CoatLook& look = {});

    [[nodiscard]] bool has_smooth_lobe() const noexcept
    {
        return even_.exists() && !even_.is_delta();
    }
    [[nodiscard]] bool is_delta() const noexcept { return even_.is_delta(); }
    /// Returns the fraction of light from `w` that the coat reflects; the base receives at most the
    /// rest.
    [[nodiscard]] float reflected(Vec3 w) const noexcept;

    // For `LayerOver`.
    [[nodiscard]] bool exists() const noexcept { return even_.exists(); }
    [[nodiscard]] float weight() const noexcept { return even_.weight(); }
    [[nodiscard]] SpecularAlbedo::Roughness row() const noexcept { return even_.row(); }
    [[nodiscard]] Rgb color_over(Rgb base) const noexcept;
    /// Light is scattered by the base, reflected by the coat, scattered again, and leaves or is
    /// reflected again. Less of it where the coat is tilted, because less is lost there on average
    /// over all azimuths.
    [[nodiscard]] Rgb returned(Rgb base) const noexcept;
    [[nodiscard]] float lost_below(const ReturnedLight& above, float cosine, float passed,
                                   float lost) const noexcept;
    /// Finds the darkening of a base by light that the coat reflects back to it inside [OpenPBR
    /// 1.1, "Coat"]: the same for all directions, so that it is reciprocal.
    void set_base(const CoveredBase& base) noexcept;
    [[nodiscard]] bool filters() const noexcept { return filters_; }
    /// Returns half the way of light through the coat, over its thickness.
    [[nodiscard]] float path(Vec3 w) const noexcept;
    /// Returns the colour of light that has gone these ways in all; `twice`: down and up again.
    [[nodiscard]] Rgb filter(float paths, bool twice) const noexcept;

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
    bool filters_;
    float darkening_;
    Rgb log_color_{0.0f};
    Rgb darkened_{1.0f};
};

static_assert(Lobe<EvenCoat> && Lobe<Coat>);

}  // namespace bdpt
