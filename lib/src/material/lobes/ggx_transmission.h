#pragma once

#include "material/lobes/boundary.h"
#include "material/lobes/ggx.h"
#include "material/lobes/lobe.h"

namespace bdpt {

/// Transmission by the microfacets of a rough boundary: refracted into or out of a solid body, and
/// through a thin wall as its reflection, flipped to the other side. Refers to the boundary.
template <typename Film, typename Alpha>
class GgxTransmission {
public:
    GgxTransmission(const Boundary<Film>& boundary, Alpha alpha)
        : boundary_(boundary), alpha_(alpha)
    {}

    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept
    {
        if (same_side(wo, wi) || !boundary_.transmits()) {
            return {};
        }
        const Vec3 o = wo.z > 0.0f ? wo : mirrored(wo);
        const Vec3 i = wo.z > 0.0f ? wi : mirrored(wi);
        const float n_o = boundary_.index_at(wo.z);
        const float n_i = boundary_.index_at(wi.z);
        const ggx::Lobe lobe = boundary_.is_solid ? ggx::refract(o, i, n_o, n_i, alpha_)
                                                  : ggx::reflect(o, mirrored(i), alpha_);
        const BoundaryShares share = boundary_.shares(lobe.cos_outer, lobe.cos_outer, 1.0f);
        const float choice = 1.0f - share.reflect_choice;
        return {share.transmitted * (lobe.f_cos * compression(n_o, n_i, mode)),
                SolidAnglePdf{choice * lobe.pdf_fwd}, SolidAnglePdf{choice * lobe.pdf_rev}};
    }
    /// Returns nullopt if the microfacet reflects, or if the transmitted light is masked.
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode) const noexcept
    {
        const ggx::Microfacet facet =
            ggx::visible_microfacet(wo.z > 0.0f ? wo : mirrored(wo), alpha_, u);
        return u_lobe < boundary_.reflect_choice(facet.cosine, wo.z) ? std::nullopt : at(wo, facet);
    }
    [[nodiscard]] bool is_delta() const noexcept { return false; }

    /// Returns the sample at a microfacet seen from above, flipped to the side of wo.
    [[nodiscard]] std::optional<BsdfSample> at(Vec3 wo, const ggx::Microfacet& facet) const noexcept
    {
        const Vec3 i = boundary_.is_solid
                           ? refracted(facet.o, facet.h, facet.cosine,
                                       boundary_.index_at(wo.z) / boundary_.index_at(-wo.z))
                           : mirrored(facet.reflected());
        if (!(i.z < 0.0f)) {
            return std::nullopt;
        }
        return towards(wo.z > 0.0f ? i : mirrored(i));
    }

private:
    const Boundary<Film>& boundary_;
    Alpha alpha_;
};

static_assert(Lobe<GgxTransmission<NoFilm, float>>);

}  // namespace bdpt
