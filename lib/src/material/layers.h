#pragma once

#include "material/gltf_bsdf.h"
#include "material/small_numbers.h"
#include "material/specular_albedo.h"

namespace bdpt {

/// Tables that all materials share whose surfaces have layers.
struct LayerTables {
    SpecularAlbedo coat{1.5f};
};

/// What is equal all over a layered material.
struct LayeredConstants {
    const SpecularAlbedo* base = nullptr;  ///< has the refractive index of the base
    const LayerTables* tables = nullptr;
};

/// A surface of several layers at one point, from the top: coat, base. As small as a `GltfBsdf`,
/// whose place it takes in path vertices; `LayeredBsdf` makes a model of it.
struct LayeredParameters {
    GltfParameters base;
    Unit16 coat{};                                ///< share of the surface that is coated
    Unit16 coat_roughness{};                      ///< perceptual
    Direction16 coat_normal{};                    ///< local, as all directions of a `LayeredBsdf`
    const LayeredConstants* constants = nullptr;  ///< must outlive this
};

}  // namespace bdpt
