#pragma once

#include "material/lobes/sheen.h"
#include "material/models/metallic_roughness.h"
#include "material/small_numbers.h"
#include "material/specular_albedo.h"

#include <bdpt/scene_desc.h>

#include <memory>
#include <span>

namespace bdpt {

class CoatLoss;

/// Tables shared by all materials with layers.
struct LayerTables {
    /// Computes the tables that these materials need.
    explicit LayerTables(std::span<const MaterialDesc> materials);
    ~LayerTables();
    LayerTables(LayerTables&&) noexcept;
    LayerTables& operator=(LayerTables&&) noexcept;
    /// Tests whether the tables that these materials need exist.
    [[nodiscard]] bool are_enough_for(std::span<const MaterialDesc> materials) const;

    std::unique_ptr<const SpecularAlbedo> coat;  ///< for index 1.5
    std::unique_ptr<const CoatLoss> coat_loss;   ///< for index 1.5
    std::unique_ptr<const SheenAlbedo> sheen;
};

/// Parameters that are constant over a layered material.
struct LayeredConstants {
    const SpecularAlbedo* base = nullptr;  ///< has the refractive index of the base
    float film_ior = 1.3f;
    const LayerTables* tables = nullptr;
};

/// A surface of several layers at one point, from the top: coat, sheen, base; the base's own
/// parameters are inherited, so that no byte is lost to padding. Compact, as it lives in path
/// vertices; `LayeredBsdf` makes a model of it.
struct LayeredParameters : GltfParameters {
    Unit8 diffuse_roughness{};  ///< 0: Lambertian. First: the base ends in padding
    Unit16 coat{};              ///< coated fraction of the surface
    Unit16 coat_roughness{};    ///< perceptual
    Direction16 coat_normal{};  ///< local, like all directions of a `LayeredBsdf`
    Unit16 sheen_roughness{};
    Color16 sheen{};
    Unit16 anisotropy{};  ///< rougher along x
    Unit16 film{};
    Unit16 diffuse_transmission{};
    Color16 transmission_color{};
    float film_thickness = 0.0f;                        ///< [nm]
    PackedPointer<const LayeredConstants> constants{};  ///< must outlive this

    LayeredParameters() = default;
    LayeredParameters(const GltfParameters& base, const LayeredConstants& equal)
        : GltfParameters(base), constants(&equal)
    {}
    void set_base(const GltfParameters& base) { static_cast<GltfParameters&>(*this) = base; }
};

}  // namespace bdpt
