#include "material/material_layers.h"

namespace bdpt {

bool has_layers(const MaterialDesc& desc)
{
    return !desc.unlit && desc.clearcoat.factor > 0.0f;
}

MaterialLayers::MaterialLayers(const MaterialDesc& desc, std::span<const TexelImage> images,
                               const SpecularAlbedo& albedo, const LayerTables& tables)
    : constants_{.base = &albedo, .tables = &tables},
      coat_(desc.clearcoat.factor),
      coat_roughness_(desc.clearcoat.roughness),
      coat_map_(make_texture(desc.clearcoat.texture, images, Encoding::linear)),
      coat_roughness_map_(make_texture(desc.clearcoat.roughness_texture, images, Encoding::linear)),
      coat_normal_map_(
          make_normal_map(desc.clearcoat.normal_texture, desc.clearcoat.normal_scale, images))
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
    return {point.ng, shading, point.wo, layers};
}

}  // namespace bdpt
