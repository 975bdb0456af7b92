#pragma once

#include "material/lobes/diffuse_reflection.h"
#include "material/models/scattering_model.h"
#include "math/elementary.h"
#include "math/warp.h"

namespace bdpt {

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

}  // namespace bdpt
