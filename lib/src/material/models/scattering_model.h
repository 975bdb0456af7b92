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

/// A model and values that depend on wo alone, computed once for all connections of a path vertex.
/// All calls must use that wo.
template <typename Model>
class SeenFrom {
public:
    SeenFrom(const Model& model, Vec3 wo) noexcept : model_(model), from_(model.side(wo.z)) {}

    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept
    {
        return model_.eval(from_, wo, wi, mode);
    }
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const noexcept
    {
        return model_.sample(from_, wo, u_lobe, u, mode);
    }
    [[nodiscard]] bool has_smooth_lobe() const noexcept { return model_.has_smooth_lobe(); }
    [[nodiscard]] bool transmits() const noexcept { return model_.transmits(); }
    [[nodiscard]] Rgb base_color() const noexcept { return model_.base_color(); }

    /// Changes wo, and computes these values again.
    void move_to(Vec3 wo) noexcept { from_ = model_.side(wo.z); }

private:
    Model model_;
    typename Model::Side from_;
};

}  // namespace bdpt
