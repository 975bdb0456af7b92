#pragma once

#include "material/bsdf_model.h"

#include <concepts>
#include <optional>
#include <type_traits>

namespace bdpt {

/// Interface of the scattering at one surface point that a `Bsdf` requires. Directions are local
/// unit vectors that point away from the surface, +z being the shading normal, outside a solid
/// body.
///
/// - `eval`: the sum over all lobes that are not delta, with the densities of all of them.
/// - `sample`: a complete sample; `u_lobe` and `u` are uniform in [0, 1).
/// - `has_smooth_lobe`: has a lobe that is not delta. `transmits`: light passes to the other side.
template <typename M>
concept ScatteringModel = std::is_trivially_copyable_v<M> &&
    requires(const M& model, Vec3 wo, Vec3 wi, float u_lobe, Vec2 u, TransportMode mode)
{
    {
        model.eval(wo, wi, mode)
    }
    noexcept->std::same_as<BsdfEval>;
    {
        model.sample(wo, u_lobe, u, mode)
    }
    noexcept->std::same_as<std::optional<BsdfSample>>;
    {
        model.has_smooth_lobe()
    }
    noexcept->std::same_as<bool>;
    {
        model.transmits()
    }
    noexcept->std::same_as<bool>;
    {
        model.base_color()
    }
    noexcept->std::same_as<Rgb>;  // in [0, 1]
};

}  // namespace bdpt
