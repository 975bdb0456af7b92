#pragma once

#include <bdpt/scene_desc.h>
#include <nanobind/nanobind.h>

#include <map>
#include <string>

namespace bdpt::python {

/// A material, and its textures by the slot that they are for.
struct ArrayMaterial {
    MaterialDesc desc;
    std::map<std::string, TexelImage> textures;
};

/// The material for `scene`, whose images get its textures.
[[nodiscard]] MaterialDesc with_textures(const ArrayMaterial& material, SceneDesc& scene);

}  // namespace bdpt::python
