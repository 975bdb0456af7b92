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

/// Returns the fibres of a material; fuzz replaces sheen.
[[nodiscard]] FuzzDesc fuzz_of(const MaterialDesc& desc)
{
    if (desc.fuzz.factor > 0.0f) {
        return desc.fuzz;
    }
    const SheenDesc& sheen = desc.sheen;
    return {.factor = is_black(sheen.color) ? 0.0f : 1.0f,
            .color = sheen.color,
            .roughness = sheen.roughness,
            .texture = {},
            .color_texture = sheen.color_texture,
            .roughness_texture = sheen.roughness_texture};
}

}  // namespace

bool has_layers(const MaterialDesc& desc)
{
    return !desc.unlit &&
           (desc.clearcoat.factor > 0.0f || !is_black(desc.sheen.color) ||
            desc.fuzz.factor > 0.0f || desc.anisotropy.strength > 0.0f ||
            desc.iridescence.factor > 0.0f || desc.diffuse_transmission.factor > 0.0f ||
            desc.diffuse_roughness.factor > 0.0f);
}

MaterialLayers::MaterialLayers(const MaterialDesc& desc, const TextureImages& images,
                               const ChannelAlbedos& albedos, const LayerTables& tables)
    : coat_(desc.clearcoat),
      fuzz_(fuzz_of(desc)),
      is_sheen_(desc.fuzz.factor == 0.0f),
      anisotropy_(desc.anisotropy),
      film_(desc.iridescence),
      transmission_(desc.diffuse_transmission),
      diffuse_roughness_(desc.diffuse_roughness.factor),
      coat_maps_{make_texture(coat_.texture, images, Encoding::linear),
                 make_texture(coat_.roughness_texture, images, Encoding::linear),
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
    return std::nullopt;
}

void MaterialLayers::add_coat(const ShadingPoint& point, const Frame& shading,
                              LayeredParameters& layers) const noexcept
{
    layers.coat = Unit16(coat_.factor * at(coat_maps_.factor, point).x);
    layers.coat_roughness = Unit16(coat_.roughness * at(coat_maps_.roughness, point).y);
    const Vec3 normal = coat_maps_.normal ? coat_maps_.normal->normal(point) : point.ns;
    layers.coat_normal = Direction16(shading.to_local(normal));
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
    const std::optional<TangentAxes> axes = tangent_axes(point);
    if (!axes) {
        return shading;  // without a direction highlights stay round
    }
    float strength = anisotropy_.strength;
    Vec2 direction(1.0f, 0.0f);
    if (anisotropy_map_) {
        const Vec4 texel = anisotropy_map_->lookup(point.uv);
        strength *= texel.z;
        const Vec2 mapped = 2.0f * Vec2(texel) - 1.0f;
        const float length = std::sqrt(dot(mapped, mapped));
        direction = length > 0.0f ? mapped / length : direction;
    }
    const SinCos turn = sin_cos(anisotropy_.rotation);
    const Vec2 turned(turn.cos * direction.x - turn.sin * direction.y,
                      turn.sin * direction.x + turn.cos * direction.y);
    const Vec3 along = turned.x * axes->tangent + turned.y * axes->bitangent;
    const Vec3 level = along - dot(along, shading.z) * shading.z;
    const float length2 = dot(level, level);
    if (!(length2 > 1e-12f)) {
        return shading;
    }
    layers.anisotropy = Unit16(strength);
    const Vec3 x = level / std::sqrt(length2);
    return {x, cross(shading.z, x), shading.z};
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
