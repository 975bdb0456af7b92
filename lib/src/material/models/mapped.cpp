#include "material/models/mapped.h"

#include "material/mapped_bsdf.h"
#include "material/models/layered.h"

namespace bdpt {
namespace {

template <typename Model>
[[nodiscard]] MappedBsdf<Model> on_facet(Vec3 ns, const Model& model)
{
    return {TiltedFacet(ns), model, model.base_color()};
}

[[nodiscard]] LayeredFacet on_facet(Vec3 ns, const Layered& model)
{
    return {TiltedFacet(ns), model.parameters()};
}

}  // namespace

template <ScatteringModel Model>
BsdfEval Mapped<Model>::eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept
{
    return on_facet(ns_.value(), model_).eval(wo, wi, mode);
}

template <ScatteringModel Model>
std::optional<BsdfSample> Mapped<Model>::sample(Vec3 wo, float u_lobe, Vec2 u,
                                                TransportMode mode) const noexcept
{
    return on_facet(ns_.value(), model_).sample(wo, u_lobe, u, mode);
}

template class Mapped<Lambertian>;
template class Mapped<MetallicRoughness>;
template class Mapped<Layered>;

}  // namespace bdpt
