#pragma once

#include "gltf/material/material_values.h"

#include <bdpt/scene_desc.h>

namespace bdpt::io {

/// Converts KHR_materials_pbrSpecularGlossiness to metallic-roughness: a dielectric of index 1.5
/// whose reflectance at normal incidence is the specular colour. It replaces base colour, metallic
/// and roughness. Does nothing if the material does not have the extension.
void read_specular_glossiness(const MaterialValues& values, MaterialDesc& desc);

}  // namespace bdpt::io
