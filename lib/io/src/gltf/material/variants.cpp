#include "gltf/material/variants.h"

namespace bdpt::io {

int variant_material(const tinygltf::Primitive& primitive, std::size_t variant)
{
    const auto found = primitive.extensions.find("KHR_materials_variants");
    if (found == primitive.extensions.end() || !found->second.Has("mappings")) {
        return primitive.material;
    }
    using Array = tinygltf::Value::Array;
    for (const tinygltf::Value& mapping : found->second.Get("mappings").Get<Array>()) {
        for (const tinygltf::Value& index : mapping.Get("variants").Get<Array>()) {
            if (static_cast<std::size_t>(index.GetNumberAsInt()) == variant) {
                return mapping.Get("material").GetNumberAsInt();
            }
        }
    }
    return primitive.material;
}

}  // namespace bdpt::io
