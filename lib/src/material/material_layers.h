#pragma once

#include "material/bsdf.h"
#include "material/channel_albedos.h"
#include "material/layers.h"
#include "material/normal_map.h"
#include "texture/texture.h"

#include <bdpt/scene_desc.h>

#include <array>
#include <optional>

namespace bdpt {

/// Tests whether the material needs more than a `PlainModel`.
[[nodiscard]] bool has_layers(const MaterialDesc& desc);

/// The factors and maps of a material's layers. Refers to the images and tables, which must outlive
/// it; must not move while its BSDFs are in use.
class MaterialLayers {
public:
    MaterialLayers(const MaterialDesc& desc, const TextureImages& images,
                   const ChannelAlbedos& albedos, const LayerTables& tables);

    /// Returns the BSDF of the layers over `base`. The normal of `shading` is that of a normal map,
    /// or that of the point.
    [[nodiscard]] Bsdf bsdf(const ShadingPoint& point, const Frame& shading,
                            const GltfParameters& base) const noexcept;
    /// Returns the set of texture coordinates that the tangent follows, if the layers need one.
    [[nodiscard]] std::optional<int> tangent_uv_set() const noexcept;

private:
    struct CoatMaps {
        std::optional<Texture> factor;
        std::optional<Texture> roughness;
        std::optional<Texture> color;
        std::optional<Texture> anisotropy;
        std::optional<NormalMap> normal;
    };
    struct FuzzMaps {
        std::optional<Texture> factor;
        std::optional<Texture> color;
        std::optional<Texture> roughness;
    };
    struct FilmMaps {
        std::optional<Texture> factor;
        std::optional<Texture> thickness;
    };
    struct TransmissionMaps {
        std::optional<Texture> factor;
        std::optional<Texture> color;
    };

    void add_coat(const ShadingPoint& point, const Frame& shading,
                  LayeredParameters& layers) const noexcept;
    void add_fuzz(const ShadingPoint& point, LayeredParameters& layers) const noexcept;
    void add_film(const ShadingPoint& point, LayeredParameters& layers) const noexcept;
    void add_transmission(const ShadingPoint& point, LayeredParameters& layers) const noexcept;
    [[nodiscard]] Frame add_anisotropy(const ShadingPoint& point, const Frame& shading,
                                       LayeredParameters& layers) const noexcept;

    // Factors; their textures are in the maps.
    CoatDesc coat_;
    bool coat_blurs_;  ///< not if it is a clearcoat
    FuzzDesc fuzz_;
    bool is_sheen_;  ///< `fuzz_` has the colour of a sheen, which is also its factor
    AnisotropyDesc anisotropy_;
    IridescenceDesc film_;
    DiffuseTransmissionDesc transmission_;
    float diffuse_roughness_;
    CoatMaps coat_maps_;
    FuzzMaps fuzz_maps_;
    FilmMaps film_maps_;
    TransmissionMaps transmission_maps_;
    std::optional<Texture> diffuse_roughness_map_;
    std::optional<Texture> anisotropy_map_;
    std::array<LayeredConstants, wavelengths> constants_;
};

}  // namespace bdpt
