#pragma once

#include "gltf/material/material_values.h"

#include <bdpt/scene_desc.h>

namespace bdpt::io {

/// Reads the layers of KHR_materials_{anisotropy, clearcoat, diffuse_transmission, iridescence,
/// sheen}. Images that have no influence are not decoded.
void read_layers(const MaterialValues& values, MaterialDesc& desc);

}  // namespace bdpt::io
