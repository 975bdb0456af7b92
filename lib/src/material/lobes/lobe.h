#pragma once

#include "material/bsdf_model.h"

#include <concepts>
#include <optional>
#include <type_traits>

namespace bdpt {

/// One lobe of a scattering model, sampled by itself; models are sums of lobes. Directions are
/// local unit vectors that point away from the surface, and none is at grazing incidence
/// (`grazes`); `wo` is the direction the walk came from, and `mode` is the quantity that it
/// carries.
///
/// - `eval`: f(wo, wi) |cos(wi)| and both densities, of sampling wi given wo and wo given wi, if
///   this lobe has been chosen. All are 0 for a delta lobe, and outside the support of the lobe.
/// - `sample`: samples wi; `u_lobe` and `u` are uniform in [0, 1). For a delta lobe it is the
///   complete sample. For others only wi is used: models evaluate all of their lobes for its
///   density.
/// - `is_delta`: scatters into single directions.
template <typename L>
concept Lobe = std::is_trivially_copyable_v<L> &&
    requires(const L& lobe, Vec3 wo, Vec3 wi, float u_lobe, Vec2 u, TransportMode mode)
{
    {
        lobe.eval(wo, wi, mode)
    }
    noexcept->std::same_as<BsdfEval>;
    {
        lobe.sample(wo, u_lobe, u, mode)
    }
    noexcept->std::same_as<std::optional<BsdfSample>>;
    {
        lobe.is_delta()
    }
    noexcept->std::same_as<bool>;
};

/// Returns the lobe's contribution to a model that chooses it with these probabilities, from wo and
/// from wi.
[[nodiscard]] inline BsdfEval chosen(BsdfEval lobe, float choice_fwd, float choice_rev)
{
    lobe.pdf_fwd.value *= choice_fwd;
    lobe.pdf_rev.value *= choice_rev;
    return lobe;
}

inline void add(BsdfEval& sum, const BsdfEval& lobe)
{
    sum.f_cos += lobe.f_cos;
    sum.pdf_fwd.value += lobe.pdf_fwd.value;
    sum.pdf_rev.value += lobe.pdf_rev.value;
}

/// Returns a sample with a direction only; the rest is evaluated later.
[[nodiscard]] inline BsdfSample towards(Vec3 wi)
{
    return {.wi = wi};
}

[[nodiscard]] inline bool same_side(Vec3 wo, Vec3 wi)
{
    return (wo.z > 0.0f) == (wi.z > 0.0f);
}

/// Reflects `w` at the plane of the surface, to its other side.
[[nodiscard]] inline Vec3 mirrored(Vec3 w)
{
    return {w.x, w.y, -w.z};
}

}  // namespace bdpt
