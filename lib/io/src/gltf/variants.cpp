#include "gltf/variants.h"

namespace bdpt::io {

int variant_material(const tinygltf::Primitive& primitive, std::size_t variant)
{
    const auto found = primitive.extensions.find("KHR_materials_variants");
    if (found == primitive.extensions.end() || !found->second.Has("mappings")) {
        return primitive.material;
    }
    const tinygltf::Value& mappings = found->second.Get("mappings");
    for (std::size_t i = 0; i < mappings.ArrayLen(); ++i) {
        const tinygltf::Value& mapping = mappings.Get(static_cast<int>(i));
        const tinygltf::Value& variants = mapping.Get("variants");
        for (std::size_t k = 0; k < variants.ArrayLen(); ++k) {
            if (static_cast<std::size_t>(variants.Get(static_cast<int>(k)).GetNumberAsInt()) ==
                variant) {
                return mapping.Get("material").GetNumberAsInt();
            }
        }
    }
    return primitive.material;
}

}  // namespace bdpt::io
