#include "material/material_layers.h"

#include "math/elementary.h"
#include "math/rgb.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace bdpt {
namespace {

/// Returns a texture's value at a point; ones without a texture.
[[nodiscard]] Vec4 at(const std::optional<Texture>& map, const ShadingPoint& point)
{
    return map ? map->lookup(point.uv, point.footprint) : Vec4(1.0f);
}

/// Grooves at a point: the direction across which highlights are blurred, unit and perpendicular to
/// the normal, and how much.
struct Grooves {
    Vec3 across;
    float strength;
};

/// Returns the grooves by KHR_materials_anisotropy; nullopt without a direction, where highlights
/// stay round.
[[nodiscard]] std::optional<Grooves> grooves_at(const ShadingPoint& point, Vec3 normal,
                                                float strength, float rotation,
                                                const std::optional<Texture>& map)
{
    const std::optional<TangentAxes> axes = tangent_axes(point);
    if (!axes) {
        return std::nullopt;
    }
    Vec2 direction(1.0f, 0.0f);
    if (map) {
        const Vec4 texel = map->lookup(point.uv);
        strength *= texel.z;
        const Vec2 mapped = 2.0f * Vec2(texel) - 1.0f;
        const float length = std::sqrt(dot(mapped, mapped));
        direction = length > 0.0f ? mapped / length : direction;
    }
    const SinCos turn = sin_cos(rotation);
    const Vec2 turned(turn.cos * direction.x - turn.sin * direction.y,
                      turn.sin * direction.x + turn.cos * direction.y);
    const Vec3 along = turned.x * axes->tangent + turned.y * axes->bitangent;
    const Vec3 level = along - dot(along, normal) * normal;
    const float length2 = dot(level, level);
    if (!(length2 > 1e-12f)) {
        return std::nullopt;
    }
    return Grooves{level / std::sqrt(length2), strength};
}

/// Returns the roughness of a base as seen through a rough coat [OpenPBR 1.1, "Coat"].
[[nodiscard]] float blurred(float roughness, float coat_roughness, float share)
{
    const float base2 = roughness * roughness;
    const float coat2 = coat_roughness * coat_roughness;
    const float sum = std::min(1.0f, base2 * base2 + 2.0f * coat2 * coat2);
    return roughness + share * (std::sqrt(std::sqrt(sum)) - roughness);
}

}  // namespace

bool has_layers(const MaterialDesc& desc)
{
    return !desc.unlit &&
           (coat_of(desc).factor > 0.0f || fuzz_of(desc).factor > 0.0f ||
            desc.anisotropy.strength > 0.0f || desc.iridescence.factor > 0.0f ||
            desc.diffuse_transmission.factor > 0.0f || desc.diffuse_roughness.factor > 0.0f);
}

MaterialLayers::MaterialLayers(const MaterialDesc& desc, const TextureImages& images,
                               const ChannelAlbedos& albedos, const LayerTables& tables)
    : coat_(coat_of(desc)),
      coat_blurs_(desc.coat.factor > 0.0f),
      fuzz_(fuzz_of(desc)),
      is_sheen_(desc.fuzz.factor == 0.0f),
      anisotropy_(desc.anisotropy),
      film_(desc.iridescence),
      transmission_(desc.diffuse_transmission),
      diffuse_roughness_(desc.diffuse_roughness.factor),
      coat_maps_{make_texture(coat_.texture, images, Encoding::linear),
                 make_texture(coat_.roughness_texture, images, Encoding::linear),
                 make_texture(coat_.color_texture, images, Encoding::srgb),
                 make_texture(coat_.anisotropy_texture, images.at_full_size(), Encoding::linear),
                 make_normal_map(coat_.normal_texture, coat_.normal_scale, images)},
      fuzz_maps_{make_texture(fuzz_.texture, images, Encoding::linear),
                 make_texture(fuzz_.color_texture, images, Encoding::srgb),
                 make_texture(fuzz_.roughness_texture, images, Encoding::linear)},
      film_maps_{make_texture(film_.texture, images, Encoding::linear),
                 make_texture(film_.thickness_texture, images, Encoding::linear)},
      transmission_maps_{make_texture(transmission_.texture, images, Encoding::linear),
                         make_texture(transmission_.color_texture, images, Encoding::srgb)},
      diffuse_roughness_map_(
          make_texture(desc.diffuse_roughness.texture, images, Encoding::linear)),
      anisotropy_map_(make_texture(anisotropy_.texture, images.at_full_size(), Encoding::linear))
{
    for (const Wavelength channel : {Wavelength::red, Wavelength::green, Wavelength::blue}) {
        constants_[static_cast<std::size_t>(channel)] = {
            .base = &albedos.at(channel),
            .film_ior = film_.ior,
            .film_thickness = std::max(film_.thickness_minimum, film_.thickness_maximum),
            .coat_darkening = coat_.darkening,
            .coat = tables.coat(coat_.ior),
            .fuzz_covers_coat = !is_sheen_,
            .tables = &tables};
    }
}

std::optional<int> MaterialLayers::tangent_uv_set() const noexcept
{
    if (coat_maps_.normal) {
        return coat_maps_.normal->uv_set();
    }
    if (anisotropy_.strength > 0.0f) {
        return anisotropy_map_ ? anisotropy_map_->uv_set() : 0;
    }
    if (coat_.factor > 0.0f && coat_.anisotropy_strength > 0.0f) {
        return coat_maps_.anisotropy ? coat_maps_.anisotropy->uv_set() : 0;
    }
    return std::nullopt;
}

void MaterialLayers::add_coat(const ShadingPoint& point, const Frame& shading,
                              LayeredParameters& layers) const noexcept
{
    layers.coat = Unit16(coat_.factor * at(coat_maps_.factor, point).x);
    layers.coat_roughness = Unit16(coat_.roughness * at(coat_maps_.roughness, point).y);
    const Vec3 normal = coat_maps_.normal ? coat_maps_.normal->normal(point) : point.ns;
    layers.coat_normal = Direction16(shading.to_local(normal));
    layers.coat_color = Color16(coat_.color * Rgb(at(coat_maps_.color, point)));
    if (coat_.anisotropy_strength > 0.0f) {
        const std::optional<Grooves> grooves =
            grooves_at(point, shading.z, coat_.anisotropy_strength, coat_.anisotropy_rotation,
                       coat_maps_.anisotropy);
        if (grooves) {
            const Vec3 across = shading.to_local(grooves->across);
            const float turns = atan2_exact(across.y, across.x) * inv_pi;
            layers.coat_axis = Unit8(turns < 0.0f ? turns + 1.0f : turns);
            layers.coat_anisotropy = Unit8(grooves->strength);
        }
    }
    if (coat_blurs_) {
        layers.roughness = Unit16(
            blurred(layers.roughness.value(), layers.coat_roughness.value(), layers.coat.value()));
    }
}

void MaterialLayers::add_fuzz(const ShadingPoint& point, LayeredParameters& layers) const noexcept
{
    Rgb color = fuzz_.color * Rgb(at(fuzz_maps_.color, point));
    float factor = fuzz_.factor * at(fuzz_maps_.factor, point).x;
    if (is_sheen_) {
        factor = max_component(color);
        color = factor > 0.0f ? color / factor : color;
    }
    layers.fuzz = Unit16(factor);
    layers.fuzz_color = Color16(color);
    layers.fuzz_roughness = Unit16(fuzz_.roughness * at(fuzz_maps_.roughness, point).w);
}

void MaterialLayers::add_film(const ShadingPoint& point, LayeredParameters& layers) const noexcept
{
    layers.film = Unit16(film_.factor * at(film_maps_.factor, point).x);
    const float share = at(film_maps_.thickness, point).y;
    const float thickness =
        film_.thickness_minimum + share * (film_.thickness_maximum - film_.thickness_minimum);
    layers.film_thickness = Unit16(thickness / std::max(layers.constants->film_thickness, 1e-3f));
}

void MaterialLayers::add_transmission(const ShadingPoint& point,
                                      LayeredParameters& layers) const noexcept
{
    layers.diffuse_transmission =
        Unit16(transmission_.factor * at(transmission_maps_.factor, point).w);
    layers.transmission_color =
        Color16(transmission_.color * Rgb(at(transmission_maps_.color, point)));
}

/// Returns the frame whose x axis is the rougher direction.
Frame MaterialLayers::add_anisotropy(const ShadingPoint& point, const Frame& shading,
                                     LayeredParameters& layers) const noexcept
{
    const std::optional<Grooves> grooves =
        grooves_at(point, shading.z, anisotropy_.strength, anisotropy_.rotation, anisotropy_map_);
    if (!grooves) {
        return shading;
    }
    layers.anisotropy = Unit16(grooves->strength);
    return {grooves->across, cross(shading.z, grooves->across), shading.z};
}

Bsdf MaterialLayers::bsdf(const ShadingPoint& point, const Frame& shading,
                          const GltfParameters& base) const noexcept
{
    const bool is_mapped = shading.z != point.ns;
    LayeredParameters layers(base, constants_[static_cast<std::size_t>(point.wavelength)]);
    Frame frame = shading;
    if (anisotropy_.strength > 0.0f) {
        frame = add_anisotropy(point, shading, layers);
    }
    if (coat_.factor > 0.0f) {
        add_coat(point, frame, layers);
    }
    if (fuzz_.factor > 0.0f) {
        add_fuzz(point, layers);
    }
    if (film_.factor > 0.0f) {
        add_film(point, layers);
    }
    if (transmission_.factor > 0.0f) {
        add_transmission(point, layers);
    }
    if (diffuse_roughness_ > 0.0f) {
        layers.diffuse_roughness = Unit8(diffuse_roughness_ * at(diffuse_roughness_map_, point).x);
    }
    const Layered model(layers);
    return is_mapped ? Bsdf(point.ng, point.ns, frame, point.wo, model)
                     : Bsdf(point.ng, frame, point.wo, model);
}

}  // namespace bdpt
