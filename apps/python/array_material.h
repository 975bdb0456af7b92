#pragma once

#include <bdpt/scene_desc.h>
#include <nanobind/nanobind.h>

#include <map>
#include <string>

namespace bdpt::python {

/// A material with its textures by slot.
struct ArrayMaterial {
    MaterialDesc desc;
    std::map<std::string, TexelImage> textures;
};

/// Returns the material for `scene`, to whose images its textures are added.
[[nodiscard]] MaterialDesc with_textures(const ArrayMaterial& material, SceneDesc& scene);

}  // namespace bdpt::python
