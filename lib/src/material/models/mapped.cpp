#include "material/models/mapped.h"

#include "material/models/recent_models.h"

namespace bdpt {
namespace {

template <typename Model>
[[nodiscard]] MappedBsdf<Model> on_facet(const Direction16& ns, const Model& model)
{
    return {TiltedFacet(ns.value()), model, model.base_color()};
}

[[nodiscard]] const LayeredFacet& on_facet(const Direction16& ns, const Layered& model)
{
    static thread_local constinit RecentModels<LayeredFacet> recent;
    return recent.get(model.parameters(), ns,
                      [&] { return LayeredFacet(TiltedFacet(ns.value()), model.parameters()); });
}

/// Tests whether a model keeps what depends on wo alone.
template <typename Model>
concept KeepsSides = requires(const SeenOnFacet<Model>& seen)
{
    seen.sides;
};

}  // namespace

template <ScatteringModel Model>
BsdfEval Mapped<Model>::eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept
{
    const auto& on = on_facet(ns_, model_);
    if constexpr (KeepsSides<Model>) {
        return on.eval(wo, wi, mode, &seen_.sides);
    } else {
        return on.eval(wo, wi, mode);
    }
}

template <ScatteringModel Model>
std::optional<BsdfSample> Mapped<Model>::sample(Vec3 wo, float u_lobe, Vec2 u,
                                                TransportMode mode) const noexcept
{
    const auto& on = on_facet(ns_, model_);
    if constexpr (KeepsSides<Model>) {
        return on.sample(wo, u_lobe, u, mode, &seen_.sides);
    } else {
        return on.sample(wo, u_lobe, u, mode);
    }
}

template <ScatteringModel Model>
void Mapped<Model>::move_to([[maybe_unused]] Vec3 wo) noexcept
{
    if constexpr (KeepsSides<Model>) {
        seen_.sides = on_facet(ns_, model_).eye_sides(wo);
    }
}

template class Mapped<Lambertian>;
template class Mapped<MetallicRoughness>;
template class Mapped<Layered>;

}  // namespace bdpt
