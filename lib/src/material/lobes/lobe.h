#pragma once

#include "material/bsdf_model.h"

#include <concepts>
#include <optional>
#include <type_traits>

namespace bdpt {

/// One way in which a surface scatters light, sampled by itself; scattering models are sums of
/// lobes. Directions are local unit vectors that point away from the surface, and none of them
/// grazes it (`grazes`); `wo` is where the walk came from, and `mode` is what that walk carries.
///
/// - `eval`: f(wo, wi) |cos(wi)| and both densities, of sampling wi given wo and wo given wi, if
///   this lobe has been chosen. All are 0 for a delta lobe, and where the lobe does not reach.
/// - `sample`: draws wi; `u_lobe` and `u` are uniform in [0, 1). Of a delta lobe it is the whole
///   sample. Of all others wi alone counts: models ask all of their lobes for its density.
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

/// What a lobe brings to a model that chooses it with these probabilities, from wo and from wi.
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

/// A sampled direction, of which the rest is to be asked for.
[[nodiscard]] inline BsdfSample towards(Vec3 wi)
{
    return {.wi = wi};
}

[[nodiscard]] inline bool same_side(Vec3 wo, Vec3 wi)
{
    return (wo.z > 0.0f) == (wi.z > 0.0f);
}

/// The reflection at the plane of the surface: on its other side.
[[nodiscard]] inline Vec3 mirrored(Vec3 w)
{
    return {w.x, w.y, -w.z};
}

}  // namespace bdpt
