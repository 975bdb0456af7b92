#pragma once

#include "file/load_context.h"
#include "gltf/material/image_table.h"

#include <bdpt/io/gltf.h>
#include <bdpt/scene_desc.h>

#include <tiny_gltf.h>

#include <functional>
#include <vector>

namespace bdpt::io {

/// Reads the materials of these indices; a negative one is the default material [glTF 2.0, sec.
/// 3.7.2.1]. All images that they need are decoded together.
[[nodiscard]] std::vector<MaterialDesc> read_materials(
    const tinygltf::Model& model, const std::vector<int>& indices, ImageTable& images,
    const std::function<void(const LoadProgress&)>& on_progress, LoadContext& context);

}  // namespace bdpt::io
