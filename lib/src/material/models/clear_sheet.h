#pragma once

#include "material/bsdf_model.h"
#include "material/models/scattering_model.h"
#include "material/small_numbers.h"
#include "material/specular_albedo.h"

#include <bdpt/types.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace bdpt {

/// A smooth thin sheet of clear glass: of the light that meets it, a part passes straight through,
/// without change of colour, and a part is reflected. Only rays that do not pass hit the sheet
/// (docs/decisions/0077-clear-sheets.md), so this model only reflects, with the sheet's reflectance
/// divided by `opacity`, the probability of a hit.
class ClearSheet {
public:
    /// Reflectances at normal and grazing incidence, and the fraction `clear` of the light that is
    /// not reflected that passes, all in [0, 1]. `albedo` has the refractive index; it must outlive
    /// this.
    ClearSheet(float f0, float f90, float clear, const SpecularAlbedo& albedo)
        : f0_(f0), f90_(f90), clear_(clear), albedo_(&albedo)
    {}

    /// Returns the fraction of rays that hit the sheet; `cosine` is |cos| to the shading normal, in
    /// [0, 1]. Equal for both directions along a line.
    [[nodiscard]] float opacity(float cosine) const noexcept
    {
        return 1.0f - clear_ * (1.0f - reflectance(cosine));
    }

    [[nodiscard]] BsdfEval eval(Vec3, Vec3, TransportMode) const noexcept { return {}; }
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float, Vec2,
                                                   TransportMode) const noexcept
    {
        const float cosine = std::abs(wo.z);
        const float reflected = reflectance(cosine);
        if (grazes(wo) || !(reflected > 0.0f)) {
            return std::nullopt;
        }
        const SolidAnglePdf pdf{cosine};
        return BsdfSample{Vec3{-wo.x, -wo.y, wo.z}, Rgb(reflected / opacity(cosine)), pdf, pdf,
                          true};
    }
    [[nodiscard]] bool has_smooth_lobe() const noexcept { return false; }
    [[nodiscard]] bool transmits() const noexcept { return false; }
    [[nodiscard]] Rgb base_color() const noexcept { return Rgb(clear_); }

private:
    [[nodiscard]] float reflectance(float cosine) const noexcept
    {
        return f0_ + (f90_ - f0_) * albedo_->fresnel_course(std::min(cosine, 1.0f));
    }

    float f0_;
    float f90_;
    float clear_;
    PackedPointer<const SpecularAlbedo> albedo_;
};

static_assert(ScatteringModel<ClearSheet>);

}  // namespace bdpt
