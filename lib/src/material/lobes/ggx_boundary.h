#pragma once

#include "material/lobes/ggx_reflection.h"
#include "material/lobes/ggx_transmission.h"

namespace bdpt {

/// Reflection and transmission by the same microfacets: a sample chooses a microfacet first, then
/// reflection or transmission. Refers to the boundary.
template <typename Film, typename Alpha>
class GgxBoundary {
public:
    GgxBoundary(const Boundary<Film>& boundary, Alpha alpha)
        : boundary_(boundary),
          alpha_(alpha),
          reflection_(boundary, alpha),
          transmission_(boundary, alpha)
    {}

    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept
    {
        return same_side(wo, wi) ? reflection_.eval(wo, wi, mode)
                                 : transmission_.eval(wo, wi, mode);
    }
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode) const noexcept
    {
        const Vec3 o = wo.z > 0.0f ? wo : mirrored(wo);
        const ggx::Microfacet facet = ggx::visible_microfacet(o, alpha_, u);
        return u_lobe < boundary_.reflect_choice(facet.cosine, wo.z) ? reflection_.at(wo, facet)
                                                                     : transmission_.at(wo, facet);
    }
    [[nodiscard]] bool is_delta() const noexcept { return false; }

private:
    const Boundary<Film>& boundary_;
    Alpha alpha_;
    GgxReflection<Film, Alpha> reflection_;
    GgxTransmission<Film, Alpha> transmission_;
};

static_assert(Lobe<GgxBoundary<NoFilm, float>>);

}  // namespace bdpt
