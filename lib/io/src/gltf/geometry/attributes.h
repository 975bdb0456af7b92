#pragma once

#include "file/load_context.h"

#include <bdpt/scene_desc.h>

#include <string>

namespace bdpt::io {

/// Repairs the attributes of a mesh to the requirements of `MeshDesc`: normals and tangents of unit
/// length, handedness +1 or -1, colours in [0, 1], everything finite. Positions and triangles must
/// be valid. Warns of changes that a correct file would not need; `place` is a JSON pointer.
void repair_attributes(MeshDesc& mesh, const std::string& place, LoadContext& context);

}  // namespace bdpt::io
