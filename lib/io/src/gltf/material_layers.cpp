#include "gltf/material_layers.h"

#include <string>

namespace bdpt::io {

namespace {

/// One extension of a material.
struct Extension {
    const MaterialValues& values;
    const tinygltf::Value& object;
    std::string name;

    [[nodiscard]] float number(const std::string& key, double fallback, double low,
                               double high) const
    {
        return values.in_range(number_or(object, key, fallback), low, high,
                               "extensions/" + name + "/" + key);
    }
    [[nodiscard]] std::optional<TextureRef> texture(const std::string& key) const
    {
        return values.texture(object, name, key);
    }
};

ClearcoatDesc read_clearcoat(const Extension& from)
{
    ClearcoatDesc coat;
    coat.factor = from.number("clearcoatFactor", 0.0, 0.0, 1.0);
    if (coat.factor == 0.0f) {
        return coat;
    }
    coat.texture = from.texture("clearcoatTexture");
    coat.roughness = from.number("clearcoatRoughnessFactor", 0.0, 0.0, 1.0);
    if (coat.roughness > 0.0f) {
        coat.roughness_texture = from.texture("clearcoatRoughnessTexture");
    }
    coat.normal_texture = from.texture("clearcoatNormalTexture");
    if (coat.normal_texture) {
        coat.normal_scale =
            static_cast<float>(number_or(from.object.Get("clearcoatNormalTexture"), "scale", 1.0));
    }
    return coat;
}

SheenDesc read_sheen(const Extension& from)
{
    SheenDesc sheen;
    sheen.color = from.values.color(from.object, "sheenColorFactor", 1.0, Rgb(0.0f));
    if (sheen.color == Rgb(0.0f)) {
        return sheen;
    }
    sheen.color_texture = from.texture("sheenColorTexture");
    sheen.roughness = from.number("sheenRoughnessFactor", 0.0, 0.0, 1.0);
    if (sheen.roughness > 0.0f) {
        sheen.roughness_texture = from.texture("sheenRoughnessTexture");
    }
    return sheen;
}

}  // namespace

void read_layers(const MaterialValues& values, MaterialDesc& desc)
{
    if (const auto* object = values.extension("KHR_materials_clearcoat")) {
        desc.clearcoat = read_clearcoat({values, *object, "KHR_materials_clearcoat"});
    }
    if (const auto* object = values.extension("KHR_materials_sheen")) {
        desc.sheen = read_sheen({values, *object, "KHR_materials_sheen"});
    }
}

}  // namespace bdpt::io
