#pragma once

#include "file/load_context.h"
#include "gltf/material/texture.h"

#include <bdpt/scene_desc.h>

#include <tiny_gltf.h>

#include <cstddef>

namespace bdpt::io {

/// Reads a glTF material with its KHR_materials extensions [glTF 2.0, sec. 3.9]. Values out of
/// range are clamped, with a warning. Images that have no influence are not decoded.
[[nodiscard]] MaterialDesc read_material(const tinygltf::Model& model, std::size_t index,
                                         TextureResolver& textures, LoadContext& context);

}  // namespace bdpt::io
