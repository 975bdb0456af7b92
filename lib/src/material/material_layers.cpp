#include "material/material_layers.h"

#include "math/rgb.h"

namespace bdpt {

bool has_layers(const MaterialDesc& desc)
{
    return !desc.unlit && (desc.clearcoat.factor > 0.0f || !is_black(desc.sheen.color));
}

MaterialLayers::MaterialLayers(const MaterialDesc& desc, std::span<const TexelImage> images,
                               const SpecularAlbedo& albedo, const LayerTables& tables)
    : constants_{.base = &albedo, .tables = &tables},
      coat_(desc.clearcoat.factor),
      coat_roughness_(desc.clearcoat.roughness),
      sheen_(desc.sheen.color),
      sheen_roughness_(desc.sheen.roughness),
      coat_map_(make_texture(desc.clearcoat.texture, images, Encoding::linear)),
      coat_roughness_map_(make_texture(desc.clearcoat.roughness_texture, images, Encoding::linear)),
      coat_normal_map_(
          make_normal_map(desc.clearcoat.normal_texture, desc.clearcoat.normal_scale, images)),
      sheen_map_(make_texture(desc.sheen.color_texture, images, Encoding::srgb)),
      sheen_roughness_map_(make_texture(desc.sheen.roughness_texture, images, Encoding::linear))
{}

std::optional<int> MaterialLayers::tangent_uv_set() const noexcept
{
    return coat_normal_map_ ? std::optional(coat_normal_map_->uv_set()) : std::nullopt;
}

Bsdf MaterialLayers::bsdf(const ShadingPoint& point, const Frame& shading,
                          const GltfParameters& base) const noexcept
{
    LayeredParameters layers{.base = base, .constants = &constants_};
    layers.coat = Unit16(coat_map_ ? coat_ * coat_map_->lookup(point.uv).x : coat_);
    layers.coat_roughness =
        Unit16(coat_roughness_map_ ? coat_roughness_ * coat_roughness_map_->lookup(point.uv).y
                                   : coat_roughness_);
    const Vec3 coat_normal = coat_normal_map_ ? coat_normal_map_->normal(point) : point.ns;
    layers.coat_normal = Direction16(shading.to_local(coat_normal));
    layers.sheen = Color16(sheen_map_ ? sheen_ * Rgb(sheen_map_->lookup(point.uv)) : sheen_);
    layers.sheen_roughness =
        Unit16(sheen_roughness_map_ ? sheen_roughness_ * sheen_roughness_map_->lookup(point.uv).w
                                    : sheen_roughness_);
    return {point.ng, shading, point.wo, layers};
}

}  // namespace bdpt
