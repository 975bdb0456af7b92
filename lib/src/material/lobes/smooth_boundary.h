#pragma once

#include "material/lobes/boundary.h"
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

}  // namespace bdpt
