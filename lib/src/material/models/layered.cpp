#include "material/models/layered.h"

#include "material/models/recent_models.h"
#include "math/elementary.h"
#include "math/rgb.h"

#include <algorithm>
#include <cmath>

namespace bdpt {
namespace {

[[nodiscard]] LayerBase make_base(const LayeredParameters& parameters)
{
    const LayeredConstants& constants = *parameters.constants;
    return {parameters.base(), *constants.base,
            AnisotropicRoughness(parameters.roughness.value(), parameters.anisotropy.value()),
            ThinFilm{.factor = parameters.film.value(),
                     .ior = constants.film_ior,
                     .thickness = parameters.film_thickness.value() * constants.film_thickness},
            TranslucentBase(
                parameters.diffuse_transmission.value(), parameters.transmission_color.value(),
                RoughDiffuse(parameters.diffuse_roughness.value(), parameters.coat.value()))};
}

/// Returns the approximate albedo of the base; above 0.
[[nodiscard]] float estimate_weight(const LayeredParameters& parameters)
{
    const float transmitted = parameters.diffuse_transmission.value() *
                              max_component(parameters.transmission_color.value());
    const float brightest = std::max(max_component(parameters.base_color), transmitted);
    return 0.05f + 0.95f * std::clamp(brightest, 0.0f, 1.0f);
}

[[nodiscard]] bool fuzz_is_on_coat(const LayeredParameters& parameters)
{
    return parameters.constants->fuzz_covers_coat && parameters.coat.value() > 0.0f;
}

[[nodiscard]] Fuzz make_fuzz(const LayeredParameters& parameters, bool on_coat)
{
    const bool is_here = fuzz_is_on_coat(parameters) == on_coat;
    return {is_here ? parameters.fuzz.value() : 0.0f, parameters.fuzz_color.value(),
            parameters.fuzz_roughness.value(), parameters.constants->tables->fuzz.get()};
}

/// Returns the coat's normal in the frame of the surface; exactly +z if it follows the surface.
[[nodiscard]] Vec3 normal_on(const SameFrame&, Vec3 normal)
{
    return normal;
}
[[nodiscard]] Vec3 normal_on(const Frame& surface, Vec3 normal)
{
    return normal == surface.z ? Vec3{0.0f, 0.0f, 1.0f} : normalize(surface.to_local(normal));
}

/// `surface` is the local frame of the coat's surface.
template <typename SurfaceFrame>
[[nodiscard]] Coat make_coat(const LayeredParameters& parameters, const SurfaceFrame& surface)
{
    const CoatTables* tables = parameters.constants->coat;
    CoatLook look{.color = parameters.coat_color.value(),
                  .darkening = parameters.constants->coat_darkening,
                  .anisotropy = parameters.coat_anisotropy.value()};
    if (look.anisotropy > 0.0f) {
        const SinCos angle = sin_cos(pi * parameters.coat_axis.value());
        look.along = surface.to_local({angle.cos, angle.sin, 0.0f});
    }
    return {tables != nullptr ? parameters.coat.value() : 0.0f, parameters.coat_roughness.value(),
            normal_on(surface, parameters.coat_normal.value()),
            tables != nullptr ? &tables->albedo : nullptr, look};
}

[[nodiscard]] bool is_solid(const LayeredParameters& parameters)
{
    return parameters.body == Body::solid;
}

[[nodiscard]] const LayerLoss* coat_loss(const LayeredParameters& parameters)
{
    return parameters.constants->coat != nullptr ? &parameters.constants->coat->loss : nullptr;
}
[[nodiscard]] const LayerLoss* fuzz_loss(const LayeredParameters& parameters)
{
    return parameters.constants->tables->fuzz_loss.get();
}

[[nodiscard]] FuzzyBase make_fuzzy_base(const LayeredParameters& parameters)
{
    return {make_fuzz(parameters, false), LowestLayer(parameters), fuzz_loss(parameters),
            is_solid(parameters)};
}

}  // namespace

LowestLayer::LowestLayer(const LayeredParameters& parameters)
    : base_(make_base(parameters)), weight_(estimate_weight(parameters))
{}

LayeredBsdf::LayeredBsdf(const LayeredParameters& parameters)
    : LayerOver(make_fuzz(parameters, true),
                {make_coat(parameters, SameFrame()), make_fuzzy_base(parameters),
                 coat_loss(parameters), is_solid(parameters)},
                fuzz_loss(parameters), is_solid(parameters))
{}

LowestFacet::LowestFacet(const TiltedFacet& facet, const LayeredParameters& parameters)
    : facet_(facet),
      base_(make_fuzzy_base(parameters)),
      color_(clamp(parameters.base_color, 0.0f, 1.0f)),
      weight_(estimate_weight(parameters))
{}

float LowestFacet::lost(const ReturnedLight& again, float z, const Side&) const noexcept
{
    const Vec3 w{std::sqrt(std::max(0.0f, 1.0f - z * z)), 0.0f, z};
    return base_.lost(again, z, base_.side(w));
}

LayeredFacet::LayeredFacet(const TiltedFacet& facet, const LayeredParameters& parameters)
    : LayeredFacet(facet, Frame::from_normal(facet.macro_normal()), parameters)
{}

LayeredFacet::LayeredFacet(const TiltedFacet& facet, const Frame& surface,
                           const LayeredParameters& parameters)
    : LayerOver(make_fuzz(parameters, true),
                {make_coat(parameters, surface), LowestFacet(facet, parameters),
                 coat_loss(parameters), is_solid(parameters), surface},
                fuzz_loss(parameters), is_solid(parameters), surface)
{}

namespace {

[[nodiscard]] const LayeredBsdf& model_of(const LayeredParameters& parameters)
{
    static thread_local constinit RecentModels<LayeredBsdf> recent;
    return recent.get(parameters, {}, [&] { return LayeredBsdf(parameters); });
}

}  // namespace

BsdfEval Layered::eval(Vec3 wo, Vec3 wi, TransportMode mode) const noexcept
{
    return model_of(parameters_).eval(wo, wi, mode);
}

std::optional<BsdfSample> Layered::sample(Vec3 wo, float u_lobe, Vec2 u,
                                          TransportMode mode) const noexcept
{
    return model_of(parameters_).sample(wo, u_lobe, u, mode);
}

bool Layered::has_smooth_lobe() const noexcept
{
    return model_of(parameters_).has_smooth_lobe();
}

}  // namespace bdpt
