#pragma once

#include "material/medium.h"
#include "material/models/layered.h"
#include "material/models/mapped.h"
#include "material/models/metallic_roughness.h"
#include "material/models/scattering_model.h"
#include "material/models/simple_models.h"

#include <variant>

namespace bdpt {

/// All models that a `Bsdf` may hold, cheap and common ones first. Visitors have no default case:
/// the compiler reports each place that does not handle a model.
using AnyModel =
    std::variant<Black, Lambertian, SeenFrom<MetallicRoughness>, Layered, Mapped<Lambertian>,
                 Mapped<MetallicRoughness>, Mapped<Layered>, HenyeyGreenstein, ClearSheet>;

/// Model of a material without layers.
using PlainModel = std::variant<Black, Lambertian, MetallicRoughness>;

/// Returns the simplest model for these parameters. `albedo` has the refractive index; it must
/// outlive the model.
[[nodiscard]] inline PlainModel plain_model(const GltfParameters& parameters,
                                            const SpecularAlbedo& albedo)
{
    if (!parameters.is_lambertian()) {
        return MetallicRoughness(parameters, albedo);
    }
    const Rgb color = glm::clamp(parameters.base_color, 0.0f, 1.0f);
    if (is_black(color)) {
        return Black(color);
    }
    return Lambertian(color);
}

// Converts models to their form in a `Bsdf`, seen from a local wo.

template <ScatteringModel Model>
[[nodiscard]] Model placed(const Model& model, Vec3) noexcept
{
    return model;
}
[[nodiscard]] inline SeenFrom<MetallicRoughness> placed(const MetallicRoughness& model,
                                                        Vec3 wo) noexcept
{
    return {model, wo};
}

// Converts models to their form on the facet of a normal map, where `ns` is the local normal of the
// surface without it, seen from a local wo.

template <ScatteringModel Model>
[[nodiscard]] Mapped<Model> mapped(const Model& model, Vec3 ns, Vec3 wo) noexcept
{
    return {model, ns, wo};
}
[[nodiscard]] inline Black mapped(const Black& model, Vec3, Vec3) noexcept
{
    return model;
}

/// Returns the cosine by which a model distinguishes directions above and below the surface.
template <ScatteringModel Model>
[[nodiscard]] float height(const Model&, Vec3 w) noexcept
{
    return w.z;
}
template <ScatteringModel Model>
[[nodiscard]] float height(const Mapped<Model>& model, Vec3 w) noexcept
{
    return model.height(w);
}

/// Returns the unit local normal to which `height` is the cosine.
template <ScatteringModel Model>
[[nodiscard]] Vec3 normal_of(const Model&) noexcept
{
    return {0.0f, 0.0f, 1.0f};
}
template <ScatteringModel Model>
[[nodiscard]] Vec3 normal_of(const Mapped<Model>& model) noexcept
{
    return model.normal();
}

}  // namespace bdpt
