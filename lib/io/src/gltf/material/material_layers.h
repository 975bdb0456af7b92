#pragma once

#include "gltf/material/material_values.h"

#include <bdpt/scene_desc.h>

namespace bdpt::io {

/// Adds what KHR_materials_{anisotropy, clearcoat, diffuse_transmission, iridescence, sheen} say.
/// Images that have no influence are not decoded.
void read_layers(const MaterialValues& values, MaterialDesc& desc);

}  // namespace bdpt::io
