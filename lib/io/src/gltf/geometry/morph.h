#pragma once

#include "file/load_context.h"
#include "gltf/geometry/primitive_reader.h"

#include <bdpt/scene_desc.h>

#include <span>

namespace bdpt::io {

/// Adds the morph targets of a primitive, each times its weight, to positions, normals, tangents,
/// texture coordinates and colours [glTF 2.0, sec. 3.7.2.2]; targets beyond the weights have weight
/// 0. Normals and tangents are not normalized. Throws `Error` (invalid_input).
void apply_morph(MeshDesc& mesh, const PrimitiveReader& primitive, std::span<const double> weights,
                 LoadContext& context);

}  // namespace bdpt::io
