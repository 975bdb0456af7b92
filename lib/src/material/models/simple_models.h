#pragma once

#include "material/bsdf_model.h"
#include "material/lobes/diffuse.h"
#include "material/models/scattering_model.h"
#include "material/small_numbers.h"
#include "material/specular_albedo.h"
#include "math/elementary.h"
#include "math/warp.h"

#include <bdpt/types.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace bdpt {

/// Scatters nothing. Its base colour is for AOVs only.
class Black {
public:
    Black() = default;
    explicit Black(Rgb base_color) : base_color_(base_color) {}

    [[nodiscard]] BsdfEval eval(Vec3, Vec3, TransportMode) const noexcept { return {}; }
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3, float, Vec2, TransportMode) const noexcept
    {
        return std::nullopt;
    }
    [[nodiscard]] bool has_smooth_lobe() const noexcept { return false; }
    [[nodiscard]] bool transmits() const noexcept { return false; }
    [[nodiscard]] Rgb base_color() const noexcept { return base_color_; }

private:
    Rgb base_color_{0.0f};
};

static_assert(ScatteringModel<Black>);

/// A diffuse surface without a boundary above it.
class Lambertian {
public:
    /// `base_color` is in [0, 1] and not black (see `Black`).
    explicit Lambertian(Rgb base_color) : base_color_(base_color) {}

    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept
    {
        return grazes(wo) || grazes(wi) ? BsdfEval{} : lobe().eval(wo, wi, mode);
    }
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float /*u_lobe*/, Vec2 u,
                                                   TransportMode /*mode*/) const noexcept
    {
        std::optional<BsdfSample> sampled;
        const Vec3 wi = square_to_cosine_hemisphere(u);
        if (!grazes(wo) && !grazes(wi)) {
            sampled.emplace();
            sampled->wi = Vec3(wi.x, wi.y, std::copysign(wi.z, wo.z));
            sampled->weight = base_color_;
            sampled->pdf_fwd = cosine_hemisphere_pdf(wi.z);
            sampled->pdf_rev = cosine_hemisphere_pdf(std::abs(wo.z));
        }
        return sampled;
    }
    [[nodiscard]] bool has_smooth_lobe() const noexcept { return true; }
    [[nodiscard]] bool transmits() const noexcept { return false; }
    [[nodiscard]] Rgb base_color() const noexcept { return base_color_; }

private:
    [[nodiscard]] DiffuseReflection lobe() const { return DiffuseReflection(base_color_ * inv_pi); }

    Rgb base_color_;
};

static_assert(ScatteringModel<Lambertian>);

/// A smooth thin sheet of clear glass: of the light that meets it, a part is reflected, and the
/// rest passes straight through, tinted by the base colour. Only the rays that are reflected hit
/// the sheet (docs/decisions/0077-clear-sheets.md), so this model is a perfect mirror.
class ClearSheet {
public:
    /// Reflectances at normal and grazing incidence, in [0, 1]. `albedo` has the refractive index;
    /// it must outlive this.
    ClearSheet(float f0, float f90, const SpecularAlbedo& albedo)
        : f0_(f0), f90_(f90), albedo_(&albedo)
    {}

    /// Returns the fraction of rays that hit the sheet; `cosine` is |cos| to the shading normal, in
    /// [0, 1]. Equal for both directions along a line, and not quite zero, so that all sheets are
    /// found by rays `without_chance`.
    [[nodiscard]] float reflectance(float cosine) const noexcept
    {
        constexpr float least = 0x1p-24f;
        const float reflected =
            f0_ + (f90_ - f0_) * albedo_->fresnel_course(std::min(cosine, 1.0f));
        return std::max(reflected, least);
    }

    [[nodiscard]] BsdfEval eval(Vec3, Vec3, TransportMode) const noexcept { return {}; }
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float, Vec2,
                                                   TransportMode) const noexcept
    {
        if (grazes(wo)) {
            return std::nullopt;
        }
        const SolidAnglePdf pdf{std::abs(wo.z)};
        return BsdfSample{Vec3{-wo.x, -wo.y, wo.z}, Rgb(1.0f), pdf, pdf, true};
    }
    [[nodiscard]] bool has_smooth_lobe() const noexcept { return false; }
    [[nodiscard]] bool transmits() const noexcept { return false; }
    [[nodiscard]] Rgb base_color() const noexcept { return Rgb(1.0f); }

private:
    float f0_;
    float f90_;
    PackedPointer<const SpecularAlbedo> albedo_;
};

static_assert(ScatteringModel<ClearSheet>);

}  // namespace bdpt
