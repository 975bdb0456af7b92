#pragma once

#include "material/lobes/boundary.h"
#include "material/lobes/ggx.h"
#include "material/lobes/lobe.h"

namespace bdpt {

/// Reflection by the microfacets of a rough boundary, seen from either side. Refers to the
/// boundary.
template <typename Film, typename Alpha>
class GgxReflection {
public:
    GgxReflection(const Boundary<Film>& boundary, Alpha alpha) : boundary_(boundary), alpha_(alpha)
    {}

    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode) const noexcept
    {
        if (!same_side(wo, wi)) {
            return {};
        }
        const Vec3 o = wo.z > 0.0f ? wo : mirrored(wo);
        const Vec3 i = wo.z > 0.0f ? wi : mirrored(wi);
        const ggx::Lobe lobe = ggx::reflect(o, i, alpha_);
        const BoundaryShares share = boundary_.shares(lobe.cos_outer, wo.z);
        return {share.reflected * lobe.f_cos, SolidAnglePdf{share.reflect_choice * lobe.pdf_fwd},
                SolidAnglePdf{share.reflect_choice * lobe.pdf_rev}};
    }
    /// Returns nullopt if the microfacet transmits, or if the reflected light is masked.
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode) const noexcept
    {
        const ggx::Microfacet facet =
            ggx::visible_microfacet(wo.z > 0.0f ? wo : mirrored(wo), alpha_, u);
        return u_lobe < boundary_.reflect_choice(facet.cosine, wo.z) ? at(wo, facet) : std::nullopt;
    }
    [[nodiscard]] bool is_delta() const noexcept { return false; }

    /// Returns the sample at a microfacet seen from above, flipped to the side of wo.
    [[nodiscard]] std::optional<BsdfSample> at(Vec3 wo, const ggx::Microfacet& facet) const noexcept
    {
        const Vec3 i = facet.reflected();
        if (!(i.z > 0.0f)) {
            return std::nullopt;
        }
        return towards(wo.z > 0.0f ? i : mirrored(i));
    }

private:
    const Boundary<Film>& boundary_;
    Alpha alpha_;
};

static_assert(Lobe<GgxReflection<NoFilm, float>>);

}  // namespace bdpt
