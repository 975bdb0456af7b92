#pragma once

#include "material/bsdf.h"
#include "material/layers.h"
#include "material/normal_map.h"
#include "material/shading_point.h"
#include "material/texture.h"

#include <bdpt/scene_desc.h>

#include <optional>
#include <span>

namespace bdpt {

/// Does the material need more than a `GltfBsdf`?
[[nodiscard]] bool has_layers(const MaterialDesc& desc);

/// The factors and maps of a material's layers. Refers to the images and tables, which must outlive
/// it; must not move while its BSDFs are in use.
class MaterialLayers {
public:
    MaterialLayers(const MaterialDesc& desc, std::span<const TexelImage> images,
                   const SpecularAlbedo& albedo, const LayerTables& tables);

    /// With `base` below the layers, whose shading normal is that of `shading`.
    [[nodiscard]] Bsdf bsdf(const ShadingPoint& point, const Frame& shading,
                            const GltfParameters& base) const noexcept;
    /// Set of texture coordinates that the tangent follows, if the layers need one.
    [[nodiscard]] std::optional<int> tangent_uv_set() const noexcept;

private:
    LayeredConstants constants_;
    float coat_;
    float coat_roughness_;
    Rgb sheen_;
    float sheen_roughness_;
    std::optional<Texture> coat_map_;
    std::optional<Texture> coat_roughness_map_;
    std::optional<NormalMap> coat_normal_map_;
    std::optional<Texture> sheen_map_;
    std::optional<Texture> sheen_roughness_map_;
};

}  // namespace bdpt
