#pragma once

#include "material/gltf_bsdf.h"
#include "material/sheen_albedo.h"
#include "material/small_numbers.h"
#include "material/specular_albedo.h"

#include <bdpt/scene_desc.h>

#include <memory>
#include <span>

namespace bdpt {

/// Tables that all materials share whose surfaces have layers.
struct LayerTables {
    /// Those that these materials need.
    explicit LayerTables(std::span<const MaterialDesc> materials);

    std::unique_ptr<const SpecularAlbedo> coat;  ///< of index 1.5
    std::unique_ptr<const SheenAlbedo> sheen;
};

/// What is equal all over a layered material.
struct LayeredConstants {
    const SpecularAlbedo* base = nullptr;  ///< has the refractive index of the base
    float film_ior = 1.3f;
    const LayerTables* tables = nullptr;
};

/// A surface of several layers at one point, from the top: coat, sheen, base. As small as a
/// `GltfBsdf`, whose place it takes in path vertices; `LayeredBsdf` makes a model of it.
struct LayeredParameters {
    GltfParameters base;
    Unit16 coat{};              ///< share of the surface that is coated
    Unit16 coat_roughness{};    ///< perceptual
    Direction16 coat_normal{};  ///< local, as all directions of a `LayeredBsdf`
    Unit16 sheen_roughness{};
    Color16 sheen{};
    Unit16 anisotropy{};  ///< rougher along x
    Unit16 film{};
    Unit16 diffuse_transmission{};
    Color16 transmission_color{};
    float film_thickness = 0.0f;                  ///< [nm]
    const LayeredConstants* constants = nullptr;  ///< must outlive this
};

}  // namespace bdpt
