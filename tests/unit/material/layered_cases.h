#pragma once

#include "material/bsdf.h"
#include "material/models/layered.h"
#include "material/models/models.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace bdpt::test {

/// A material that the BSDF tests run over.
struct BsdfCase {
    std::string name;
    GltfParameters surface;
    float ior = 1.5f;
    /// Its `base` and `constants` do not count.
    std::optional<LayeredParameters> layers{};
    /// The coat has a normal of its own: f is reciprocal with other cosines only.
    bool tilted_coat = false;
    bool fuzz_on_coat = false;  ///< the fibres are on the coat, not below it
    float coat_ior = 1.5f;
    float coat_darkening = 0.0f;

    [[nodiscard]] bool refracts() const
    {
        return surface.body == Body::solid && surface.transmission > 0.0f;
    }
};

/// The model of a case, whichever it is.
class TestedBsdf {
    template <typename Visitor>
    [[nodiscard]] auto visit(const Visitor& visitor) const
    {
        return layered_ ? visitor(*layered_) : std::visit(visitor, plain_);
    }

public:
    explicit TestedBsdf(const BsdfCase& tested)
        : albedo_(std::make_unique<const SpecularAlbedo>(tested.ior)),
          plain_(plain_model(tested.surface, *albedo_))
    {
        if (tested.layers) {
            static const LayerTables tables = all_tables();
            if (tested.coat_ior != 1.5f) {
                coat_ = std::make_unique<const CoatTables>(tested.coat_ior, nullptr);
            }
            constants_ = std::make_unique<const LayeredConstants>(
                LayeredConstants{.base = albedo_.get(),
                                 .film_ior = 1.8f,
                                 .film_thickness = 1000.0f,
                                 .coat_darkening = tested.coat_darkening,
                                 .coat = coat_ ? coat_.get() : tables.coat(1.5f),
                                 .fuzz_covers_coat = tested.fuzz_on_coat,
                                 .tables = &tables});
            LayeredParameters layers = *tested.layers;
            layers.set_base(tested.surface);
            layers.constants = PackedPointer(constants_.get());
            layered_.emplace(layers);
            small_layered_.emplace(layers);
        }
    }

    [[nodiscard]] BsdfEval eval(Vec3 wo, Vec3 wi, TransportMode mode) const
    {
        return visit([&](const auto& model) { return model.eval(wo, wi, mode); });
    }
    [[nodiscard]] std::optional<BsdfSample> sample(Vec3 wo, float u_lobe, Vec2 u,
                                                   TransportMode mode) const
    {
        return visit([&](const auto& model) { return model.sample(wo, u_lobe, u, mode); });
    }
    /// On a facet with the normal `facet.z` of a surface with the normals `ng` and `ns`.
    [[nodiscard]] Bsdf mapped(Vec3 ng, Vec3 ns, const Frame& facet, Vec3 wo) const
    {
        const auto placed = [&](const auto& model) { return Bsdf(ng, ns, facet, wo, model); };
        return small_layered_ ? placed(*small_layered_) : std::visit(placed, plain_);
    }
    /// At a surface with these normals, seen from wo.
    [[nodiscard]] Bsdf at(Vec3 ng, Vec3 ns, Vec3 wo) const
    {
        const Frame shading = Frame::from_normal(ns);
        const auto placed = [&](const auto& model) { return Bsdf(ng, shading, wo, model); };
        return small_layered_ ? placed(*small_layered_) : std::visit(placed, plain_);
    }
    [[nodiscard]] bool has_smooth_lobe() const
    {
        return visit([](const auto& model) { return model.has_smooth_lobe(); });
    }

private:
    [[nodiscard]] static LayerTables all_tables()
    {
        MaterialDesc everything;
        everything.clearcoat.factor = 1.0f;
        everything.fuzz.factor = 1.0f;
        return LayerTables({&everything, 1});
    }

    std::unique_ptr<const SpecularAlbedo> albedo_;
    std::unique_ptr<const CoatTables> coat_;
    std::unique_ptr<const LayeredConstants> constants_;
    PlainModel plain_;
    std::optional<LayeredBsdf> layered_;
    std::optional<Layered> small_layered_;
};

[[nodiscard]] inline LayeredParameters coated(float share, float roughness,
                                              Vec3 normal = {0.0f, 0.0f, 1.0f},
                                              LayeredParameters layers = {})
{
    layers.coat = Unit16(share);
    layers.coat_roughness = Unit16(roughness);
    layers.coat_normal = Direction16(normalize(normal));
    return layers;
}

/// Colours the coat, and makes it rougher along a direction.
[[nodiscard]] inline LayeredParameters lacquered(Rgb color, float anisotropy,
                                                 LayeredParameters layers)
{
    layers.coat_color = Color16(color);
    layers.coat_anisotropy = Unit8(anisotropy);
    layers.coat_axis = Unit8(0.2f);
    return layers;
}

[[nodiscard]] inline LayeredParameters fuzzy(float share, Rgb color, float roughness,
                                             LayeredParameters layers = {})
{
    layers.fuzz = Unit16(share);
    layers.fuzz_color = Color16(color);
    layers.fuzz_roughness = Unit16(roughness);
    return layers;
}

/// The brightest channel is the share of the surface.
[[nodiscard]] inline LayeredParameters sheen(Rgb color, float roughness,
                                             LayeredParameters layers = {})
{
    const float share = std::max({color.r, color.g, color.b});
    return fuzzy(share, color / share, roughness, layers);
}

[[nodiscard]] inline LayeredParameters brushed(float strength, LayeredParameters layers = {})
{
    layers.anisotropy = Unit16(strength);
    return layers;
}

/// Of index 1.8.
[[nodiscard]] inline LayeredParameters filmed(float factor, float thickness,
                                              LayeredParameters layers = {})
{
    layers.film = Unit16(factor);
    layers.film_thickness = Unit16(thickness / 1000.0f);
    return layers;
}

[[nodiscard]] inline LayeredParameters translucent(float share, Rgb color,
                                                   LayeredParameters layers = {})
{
    layers.diffuse_transmission = Unit16(share);
    layers.transmission_color = Color16(color);
    return layers;
}

[[nodiscard]] inline LayeredParameters rough_diffuse(float roughness, LayeredParameters layers = {})
{
    layers.diffuse_roughness = Unit8(roughness);
    return layers;
}

/// Materials with layers, over all kinds of bases.
[[nodiscard]] inline std::vector<BsdfCase> layered_cases()
{
    const Rgb blue{0.2f, 0.5f, 0.8f};
    const Rgb white{1.0f};
    constexpr Body thin = Body::thin_walled;
    constexpr Body solid = Body::solid;
    const Vec3 tilt{0.3f, -0.2f, 1.0f};
    return {
        {"coat 0.2 on lambert", {blue, 0, 1, 0}, 1.5f, coated(1, 0.2f)},
        {"smooth coat on dielectric 0.5", {blue, 0, 0.5f}, 1.5f, coated(1, 0)},
        {"half coat 0.4 on metal 0.2", {blue, 1, 0.2f}, 1.5f, coated(0.5f, 0.4f)},
        {"coat 0.3 on a mirror", {blue, 1, 0}, 1.5f, coated(1, 0.3f)},
        {"smooth coat on a mirror", {blue, 1, 0}, 1.5f, coated(1, 0)},
        {"coat 1 on black", {Rgb{0.0f}, 0, 1, 0}, 1.5f, coated(1, 1)},
        {"coat 0.3 on thin glass 0.4", {blue, 0, 0.4f, 1, white, 1, thin}, 1.5f, coated(1, 0.3f)},
        {"coat 0.3 on glass 0.4", {blue, 0, 0.4f, 1, white, 0.8f, solid}, 1.4f, coated(1, 0.3f)},
        {"smooth coat on glass", {white, 0, 0, 1, white, 1, solid}, 1.5f, coated(0.7f, 0)},
        {"sheen 0.5 on lambert", {blue, 0, 1, 0}, 1.5f, sheen(white, 0.5f)},
        {"red sheen 0.2 on dielectric 0.6", {blue, 0, 0.6f}, 1.5f, sheen({0.9f, 0.3f, 0.1f}, 0.2f)},
        {"sheen 1 on a mirror", {blue, 1, 0}, 1.5f, sheen(white, 1)},
        {"sheen 0.3 on black", {Rgb{0.0f}, 0, 1, 0}, 1.5f, sheen(white, 0.3f)},
        {"sheen 0.4 on glass 0.4",
         {blue, 0, 0.4f, 1, white, 0.8f, solid},
         1.4f,
         sheen({0.2f, 0.7f, 0.5f}, 0.4f)},
        {"coat 0.3 on sheen 0.6 on metal 0.4",
         {blue, 1, 0.4f},
         1.5f,
         sheen({0.5f, 0.9f, 0.7f}, 0.6f, coated(0.8f, 0.3f))},
        {"fuzz 0.3 on a coat 0.3 on dielectric 0.4",
         {blue, 0, 0.4f},
         1.5f,
         fuzzy(0.8f, {0.5f, 0.9f, 0.7f}, 0.3f, coated(0.8f, 0.3f)),
         false,
         true},
        {"fuzz 0.7 on a smooth coat on lambert",
         {blue, 0, 1, 0},
         1.5f,
         fuzzy(1, white, 0.7f, coated(1, 0)),
         false,
         true},
        {"dark red coat 0.3 of index 2 on dielectric 0.5",
         {blue, 0, 0.5f},
         1.5f,
         lacquered({0.9f, 0.2f, 0.1f}, 0, coated(0.9f, 0.3f)),
         false,
         false,
         2.0f,
         1.0f},
        {"brushed coat 0.3 on metal 0.4",
         {blue, 1, 0.4f},
         1.5f,
         lacquered({0.8f, 0.9f, 0.5f}, 0.6f, coated(1, 0.3f)),
         false,
         false,
         1.5f,
         0.5f},
        {"yellow smooth coat of index 1 on glass 0.4",
         {blue, 0, 0.4f, 1, white, 0.8f, solid},
         1.4f,
         lacquered({0.9f, 0.8f, 0.1f}, 0, coated(1, 0)),
         false,
         false,
         1.0f,
         1.0f},
        {"black fuzz 0.8 on dielectric 0.5", {blue, 0, 0.5f}, 1.5f, fuzzy(0.9f, Rgb{0.0f}, 0.8f)},
        {"brushed metal 0.2", {blue, 1, 0.2f}, 1.5f, brushed(0.7f)},
        {"brushed metal 0.1", {blue, 1, 0.1f}, 1.5f, brushed(0.5f)},
        {"brushed dielectric 0.4", {blue, 0, 0.4f}, 1.5f, brushed(0.8f)},
        {"brushed glass 0.3", {white, 0, 0.3f, 1, white, 1, solid}, 1.5f, brushed(0.6f)},
        {"brushed thin glass 0.3", {blue, 0, 0.3f, 1, white, 0.7f, thin}, 1.5f, brushed(0.6f)},
        {"brushed ior 1", {blue, 0.5f, 0.4f, 1, white, 1, solid}, 1.0f, brushed(0.6f)},
        {"film on dielectric 0.3", {blue, 0, 0.3f}, 1.5f, filmed(1, 400)},
        {"thin film on smooth dielectric", {blue, 0, 0}, 1.5f, filmed(1, 120)},
        {"half a film on metal 0.3", {blue, 1, 0.3f}, 1.5f, filmed(0.5f, 550)},
        {"film on glass 0.3", {white, 0, 0.3f, 1, white, 1, solid}, 1.5f, filmed(1, 300)},
        {"film on thin glass", {white, 0, 0, 1, white, 1, thin}, 1.5f, filmed(1, 300)},
        {"film without a boundary", {blue, 0, 0.5f, 0}, 1.0f, filmed(1, 250)},
        {"translucent lambert", {blue, 0, 1, 0}, 1.5f, translucent(0.6f, {0.9f, 0.7f, 0.3f})},
        {"translucent dielectric 0.4", {blue, 0, 0.4f}, 1.5f, translucent(0.3f, white)},
        {"wholly translucent smooth", {blue, 0, 0}, 1.5f, translucent(1, {0.5f, 0.9f, 0.2f})},
        {"translucent half transmission",
         {blue, 0, 0.4f, 1, white, 0.5f, thin},
         1.5f,
         translucent(0.5f, white)},
        {"translucent in glass",
         {blue, 0, 0.4f, 1, white, 0.5f, solid},
         1.5f,
         translucent(0.5f, white)},
        {"rough lambert", {blue, 0, 1, 0}, 1.5f, rough_diffuse(0.5f)},
        {"rough base below dielectric 0.3", {blue, 0, 0.3f}, 1.5f, rough_diffuse(1)},
        {"rough base below a smooth coat",
         {blue, 0, 1},
         1.5f,
         coated(1, 0, {0, 0, 1}, rough_diffuse(1))},
        {"half translucent rough base",
         {blue, 0, 0.5f},
         1.5f,
         translucent(0.4f, white, rough_diffuse(0.8f))},
        {"all layers",
         {blue, 0.3f, 0.4f, 0.8f, white, 0.3f, thin},
         1.4f,
         coated(0.6f, 0.2f, {0, 0, 1},
                sheen({0.4f, 0.3f, 0.5f}, 0.5f,
                      brushed(0.5f, filmed(0.7f, 350, translucent(0.4f, {0.9f, 0.5f, 0.4f})))))},
        {"tilted coat 0.3 on lambert", {blue, 0, 1, 0}, 1.5f, coated(1, 0.3f, tilt), true},
        {"tilted brushed blue coat 0.4 on lambert",
         {white, 0, 1, 0},
         1.5f,
         lacquered({0.2f, 0.5f, 0.9f}, 0.5f, coated(1, 0.4f, tilt)),
         true,
         false,
         1.5f,
         1.0f},
        {"tilted smooth coat on metal 0.3", {blue, 1, 0.3f}, 1.5f, coated(1, 0, tilt), true},
    };
}

}  // namespace bdpt::test
