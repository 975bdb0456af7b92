#pragma once

#include <tiny_gltf.h>

#include <cstddef>

namespace bdpt::io {

/// Returns the material of a primitive in a variant of KHR_materials_variants: the one mapped to it
/// or, if there is none, that of the primitive; -1: the default material.
[[nodiscard]] int variant_material(const tinygltf::Primitive& primitive, std::size_t variant);

}  // namespace bdpt::io
