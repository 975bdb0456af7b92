#pragma once

#include "material/lobes/lobe.h"
#include "material/lobes/returned_light.h"
#include "material/specular_albedo.h"
#include "material/tilted_facet.h"
#include "math/elementary.h"
#include "math/frame.h"
#include "math/rgb.h"

#include <bdpt/types.h>

#include <algorithm>
#include <cmath>
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
    /// Returns the average of `reflected`.
    [[nodiscard]] float average() const noexcept;
    [[nodiscard]] float weight() const noexcept { return weight_; }
    [[nodiscard]] SpecularAlbedo::Roughness row() const noexcept { return roughness_; }
    [[nodiscard]] float normal_reflectance() const noexcept
    {
        return albedo_->normal_reflectance();
    }

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

    // For `LayerOver`.
    [[nodiscard]] bool exists() const noexcept { return even_.exists(); }
    [[nodiscard]] float weight() const noexcept { return even_.weight(); }
    [[nodiscard]] SpecularAlbedo::Roughness row() const noexcept { return even_.row(); }
    [[nodiscard]] Rgb color_over(Rgb base) const noexcept
    {
        const float reflected = even_.average();
        return Rgb(reflected) + (1.0f - reflected) * base;
    }
    /// Light is scattered by the base, reflected by the coat, scattered again, and leaves or is
    /// reflected again. Less of it where the coat is tilted, because less is lost there on average
    /// over all azimuths.
    [[nodiscard]] Rgb returned(Rgb base) const noexcept;
    [[nodiscard]] float lost_below(const ReturnedLight& above, float cosine, float passed,
                                   float lost) const noexcept;

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

}  // namespace bdpt
