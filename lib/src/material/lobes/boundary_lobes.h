#pragma once

#include "material/lobes/boundary.h"
#include "material/lobes/ggx.h"
#include "material/lobes/lobe.h"

#include <cmath>

namespace bdpt {

/// A perfectly smooth boundary: it reflects and refracts into single directions. Refers to the
/// boundary. Samples of delta lobes are complete, so they include the probability with which the
/// model chooses this lobe: `choice` from wo, and `choice_at(z)` from other directions.
template <typename Film, typename ChoiceAt>
class SmoothBoundary {
public:
    SmoothBoundary(const Boundary<Film>& boundary, float choice, const ChoiceAt& choice_at)
        : boundary_(boundary), choice_(choice), choice_at_(choice_at)
    {}

    [[nodiscard]] BsdfEval eval(Vec3, Vec3, TransportMode) const noexcept { return {}; }
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2,
                                                   TransportMode mode) const noexcept
    {
        const float cos_o = std::abs(wo.z);
        const BoundaryShares share = boundary_.shares(cos_o, wo.z);
        const float n_o = boundary_.index_at(wo.z);
        if (u_lobe < share.reflect_choice) {
            const float choice = choice_ * share.reflect_choice;
            const SolidAnglePdf pdf{choice * cos_o * n_o * n_o};
            return BsdfSample{Vec3{-wo.x, -wo.y, wo.z}, share.reflected / choice, pdf, pdf, true};
        }
        const float choice = 1.0f - share.reflect_choice;
        const float n_i = boundary_.index_at(-wo.z);
        const Vec3 normal{0.0f, 0.0f, std::copysign(1.0f, wo.z)};
        const Vec3 wi = boundary_.is_solid ? refracted(wo, normal, cos_o, n_o / n_i) : -wo;
        return BsdfSample{wi,
                          share.transmitted * (compression(n_o, n_i, mode) / (choice_ * choice)),
                          SolidAnglePdf{choice_ * choice * std::abs(wi.z) * n_i * n_i},
                          SolidAnglePdf{choice_at_(wi.z) * choice * cos_o * n_o * n_o}, true};
    }
    [[nodiscard]] bool is_delta() const noexcept { return true; }

private:
    const Boundary<Film>& boundary_;
    float choice_;
    ChoiceAt choice_at_;
};

static_assert(Lobe<SmoothBoundary<NoFilm, float (*)(float) noexcept>>);

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
