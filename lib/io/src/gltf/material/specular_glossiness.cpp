#include "gltf/material/specular_glossiness.h"

#include <cstddef>
#include <string>

namespace bdpt::io {

void read_specular_glossiness(const MaterialValues& values, MaterialDesc& desc)
{
    const std::string name = "KHR_materials_pbrSpecularGlossiness";
    const auto* object = values.extension(name);
    if (object == nullptr) {
        return;
    }
    const std::string place = "extensions/" + name + "/";
    desc.base_color = Vec4(1.0f);
    if (object->Has("diffuseFactor")) {
        const auto& factor = object->Get("diffuseFactor").Get<tinygltf::Value::Array>();
        for (int c = 0; c < 4; ++c) {
            desc.base_color[c] =
                values.in_range(factor[static_cast<std::size_t>(c)].GetNumberAsDouble(), 0.0, 1.0,
                                place + "diffuseFactor");
        }
    }
    desc.base_color_texture = values.texture(*object, name, "diffuseTexture");
    desc.metallic = 0.0f;
    desc.metallic_roughness_texture.reset();
    const double glossiness = number_or(*object, "glossinessFactor", 1.0);
    desc.roughness = 1.0f - values.in_range(glossiness, 0.0, 1.0, place + "glossinessFactor");
    // Reflectance of index 1.5, which the specular colour multiplies.
    constexpr float reflectance = 0.04f;
    const Rgb specular = values.color(*object, "specularFactor", 1.0);
    desc.ior = 1.5f;
    desc.specular = 1.0f;
    desc.specular_color = specular / reflectance;
    const auto texture = values.texture(*object, name, "specularGlossinessTexture");
    if (specular != Rgb(0.0f)) {
        desc.specular_color_texture = texture;
    }
    if (desc.roughness < 1.0f) {
        desc.glossiness_texture = texture;
    }
}

}  // namespace bdpt::io
