#pragma once

#include "gltf/material/material_values.h"

#include <bdpt/scene_desc.h>

namespace bdpt::io {

/// What KHR_materials_pbrSpecularGlossiness says, in the words of metallic-roughness: a dielectric
/// of index 1.5 whose reflectance at normal incidence is the specular colour. It takes the place of
/// base colour, metallic and roughness. Does nothing where the material does not have it.
void read_specular_glossiness(const MaterialValues& values, MaterialDesc& desc);

}  // namespace bdpt::io
