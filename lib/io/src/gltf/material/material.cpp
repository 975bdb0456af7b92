#include "gltf/material/material.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>

namespace bdpt::io {

float MaterialValues::in_range(double value, double low, double high, std::string_view key) const
{
    if (value >= low && value <= high) {
        return static_cast<float>(value);
    }
    const double nearest = std::clamp(value, low, high);
    context_.warn("an out-of-range material value is clamped",
                  fmt::format("{}/{}: {} becomes {}", place_, key, value, nearest));
    return static_cast<float>(nearest);
}

const tinygltf::Value* MaterialValues::extension(const std::string& name) const
{
    const auto found = source_.extensions.find(name);
    return found == source_.extensions.end() ? nullptr : &found->second;
}

Rgb MaterialValues::color(const tinygltf::Value& object, const std::string& key, double high,
                          Rgb fallback) const
{
    if (!object.Has(key)) {
        return fallback;
    }
    const auto& values = object.Get(key).Get<tinygltf::Value::Array>();
    Rgb rgb;
    for (int c = 0; c < 3; ++c) {
        rgb[c] = in_range(values[static_cast<std::size_t>(c)].GetNumberAsDouble(), 0.0, high, key);
    }
    return rgb;
}

std::optional<TextureRef> MaterialValues::texture(const tinygltf::Value& object,
                                                  const std::string& name,
                                                  const std::string& key) const
{
    return textures_.resolve(texture_info(object, key),
                             fmt::format("{}/extensions/{}/{}", place_, name, key));
}

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

namespace {

/// Reads one material; pointers in messages are relative to it.
class MaterialReader {
public:
    MaterialReader(const tinygltf::Material& source, std::size_t index, TextureResolver& textures,
                   LoadContext& context)
        : source_(source),
          place_(fmt::format("/materials/{}", index)),
          textures_(textures),
          context_(context),
          values_(source, place_, textures, context)
    {}

    [[nodiscard]] MaterialDesc read()
    {
        desc_.name = source_.name;
        desc_.double_sided = source_.doubleSided;
        read_base_color();
        read_alpha();
        read_specular_glossiness(values_, desc_);
        if (values_.extension("KHR_materials_unlit") != nullptr) {
            desc_.unlit = true;  // the rest is for viewers that do not know the extension
            return std::move(desc_);
        }
        read_emission();
        if (values_.extension("KHR_materials_pbrSpecularGlossiness") == nullptr) {
            read_metallic_roughness();
            read_ior();
            read_specular();
        }
        read_transmission();
        read_volume();
        read_volume_scatter();
        read_scatter();
        read_layers(values_, desc_);
        if (source_.normalTexture.index >= 0) {
            desc_.normal_scale = static_cast<float>(source_.normalTexture.scale);
            desc_.normal_texture =
                textures_.resolve(texture_info(source_.normalTexture), place_ + "/normalTexture");
        }
        return std::move(desc_);
    }

private:
    void read_base_color()
    {
        const auto& pbr = source_.pbrMetallicRoughness;
        for (int c = 0; c < 4; ++c) {
            desc_.base_color[c] =
                values_.in_range(pbr.baseColorFactor[static_cast<std::size_t>(c)], 0.0, 1.0,
                                 "pbrMetallicRoughness/baseColorFactor");
        }
        desc_.base_color_texture = textures_.resolve(
            texture_info(pbr.baseColorTexture), place_ + "/pbrMetallicRoughness/baseColorTexture");
    }

    void read_alpha()
    {
        const std::string& mode = source_.alphaMode;
        if (mode == "MASK") {
            desc_.alpha_mode = AlphaMode::mask;
            desc_.alpha_cutoff =
                values_.in_range(source_.alphaCutoff, 0.0, no_limit, "alphaCutoff");
        } else if (mode == "BLEND") {
            desc_.alpha_mode = AlphaMode::blend;
        } else if (mode != "OPAQUE" && !mode.empty()) {
            context_.warn("an unknown alpha mode is treated as OPAQUE",
                          place_ + "/alphaMode: " + mode);
        }
    }

    void read_metallic_roughness()
    {
        const auto& pbr = source_.pbrMetallicRoughness;
        desc_.metallic =
            values_.in_range(pbr.metallicFactor, 0.0, 1.0, "pbrMetallicRoughness/metallicFactor");
        desc_.roughness =
            values_.in_range(pbr.roughnessFactor, 0.0, 1.0, "pbrMetallicRoughness/roughnessFactor");
        if (desc_.metallic > 0.0f || desc_.roughness > 0.0f) {
            desc_.metallic_roughness_texture =
                textures_.resolve(texture_info(pbr.metallicRoughnessTexture),
                                  place_ + "/pbrMetallicRoughness/metallicRoughnessTexture");
        }
    }

    void read_emission()
    {
        double strength = 1.0;
        if (const auto* value = values_.extension("KHR_materials_emissive_strength")) {
            strength =
                values_.in_range(number_or(*value, "emissiveStrength", 1.0), 0.0, no_limit,
                                 "extensions/KHR_materials_emissive_strength/emissiveStrength");
        }
        for (int c = 0; c < 3; ++c) {
            const double factor = source_.emissiveFactor[static_cast<std::size_t>(c)];
            // Factors above 1 were common before the extension for emissive strength.
            desc_.emission[c] = values_.in_range(
                values_.in_range(factor, 0.0, no_limit, "emissiveFactor") * strength, 0.0, no_limit,
                "emissiveFactor");
        }
        if (desc_.emission != Rgb(0.0f)) {
            desc_.emission_texture = textures_.resolve(texture_info(source_.emissiveTexture),
                                                       place_ + "/emissiveTexture");
        }
    }

    void read_ior()
    {
        const auto* value = values_.extension("KHR_materials_ior");
        if (value == nullptr) {
            return;
        }
        const double ior = number_or(*value, "ior", 1.5);
        // 0 stands for a Fresnel term of one, that of an infinite index [KHR_materials_ior].
        constexpr double nearly_infinite = 1e4;
        desc_.ior = ior == 0.0
                        ? static_cast<float>(nearly_infinite)
                        : values_.in_range(ior, 1.0, no_limit, "extensions/KHR_materials_ior/ior");
    }

    void read_specular()
    {
        const auto* value = values_.extension("KHR_materials_specular");
        if (value == nullptr) {
            return;
        }
        const std::string at = place_ + "/extensions/KHR_materials_specular/";
        desc_.specular = values_.in_range(number_or(*value, "specularFactor", 1.0), 0.0, 1.0,
                                          "extensions/KHR_materials_specular/specularFactor");
        desc_.specular_color = values_.color(*value, "specularColorFactor", no_limit);
        if (desc_.specular > 0.0f) {
            desc_.specular_texture =
                textures_.resolve(texture_info(*value, "specularTexture"), at + "specularTexture");
            desc_.specular_color_texture = textures_.resolve(
                texture_info(*value, "specularColorTexture"), at + "specularColorTexture");
        }
    }

    void read_transmission()
    {
        const auto* value = values_.extension("KHR_materials_transmission");
        if (value == nullptr) {
            return;
        }
        desc_.transmission =
            values_.in_range(number_or(*value, "transmissionFactor", 0.0), 0.0, 1.0,
                             "extensions/KHR_materials_transmission/transmissionFactor");
        if (desc_.transmission > 0.0f) {
            desc_.transmission_texture =
                textures_.resolve(texture_info(*value, "transmissionTexture"),
                                  place_ +
                                      "/extensions/KHR_materials_transmission/"
                                      "transmissionTexture");
        }
    }

    void read_volume()
    {
        const auto* value = values_.extension("KHR_materials_volume");
        if (value == nullptr) {
            return;
        }
        desc_.thickness = values_.in_range(number_or(*value, "thicknessFactor", 0.0), 0.0, no_limit,
                                           "extensions/KHR_materials_volume/thicknessFactor");
        desc_.attenuation_color = values_.color(*value, "attenuationColor", 1.0);
        if (!value->Has("attenuationDistance")) {
            return;
        }
        const double distance = value->Get("attenuationDistance").GetNumberAsDouble();
        if (static_cast<float>(distance) > 0.0f) {
            desc_.attenuation_distance = static_cast<float>(distance);
        } else {
            context_.warn("an attenuation distance must be above 0; there is no attenuation",
                          fmt::format("{}/extensions/KHR_materials_volume/attenuationDistance: {}",
                                      place_, distance));
        }
    }

    /// Reads the draft of September 2025; older files call the colour a factor.
    void read_volume_scatter()
    {
        const auto* value = values_.extension("KHR_materials_volume_scatter");
        if (value == nullptr) {
            return;
        }
        const char* color =
            value->Has("multiscatterColor") ? "multiscatterColor" : "multiscatterColorFactor";
        desc_.volume_scatter.color = values_.color(*value, color, 1.0, Rgb(0.0f));
        constexpr auto most = static_cast<double>(max_anisotropy);
        desc_.volume_scatter.anisotropy =
            values_.in_range(number_or(*value, "scatterAnisotropy", 0.0), -most, most,
                             "extensions/KHR_materials_volume_scatter/scatterAnisotropy");
    }

    /// Reads the draft of June 2026, the successor of KHR_materials_volume_scatter. Called after
    /// the volume is read.
    void read_scatter()
    {
        const auto* value = values_.extension("KHR_materials_scatter");
        if (value == nullptr) {
            return;
        }
        const std::string at = "extensions/KHR_materials_scatter/";
        const float strength = values_.in_range(number_or(*value, "scatterStrengthFactor", 0.0),
                                                0.0, 1.0, at + "scatterStrengthFactor");
        if (strength == 0.0f) {
            desc_.volume_scatter = {};
            return;
        }
        if (desc_.thickness == 0.0f) {
            context_.warn(WarningKind::loss,
                          "KHR_materials_scatter is supported in bodies with a thickness only; "
                          "this sheet does not scatter",
                          fmt::format("{}/{}scatterStrengthFactor", place_, at));
            return;
        }
        for (const char* texture : {"scatterStrengthTexture", "multiscatterColorTexture"}) {
            if (value->Has(texture)) {
                context_.warn(WarningKind::loss, "textures of KHR_materials_scatter are ignored",
                              fmt::format("{}/{}{}", place_, at, texture));
            }
        }
        constexpr auto most = static_cast<double>(max_anisotropy);
        desc_.volume_scatter = {
            .color = strength * values_.color(*value, "multiscatterColorFactor", 1.0),
            .anisotropy = values_.in_range(number_or(*value, "scatterAnisotropy", 0.0), -most, most,
                                           at + "scatterAnisotropy")};
    }

    const tinygltf::Material& source_;
    std::string place_;
    TextureResolver& textures_;
    LoadContext& context_;
    MaterialValues values_;
    MaterialDesc desc_;
};

}  // namespace

MaterialDesc read_material(const tinygltf::Model& model, std::size_t index,
                           TextureResolver& textures, LoadContext& context)
{
    return MaterialReader(model.materials[index], index, textures, context).read();
}

}  // namespace bdpt::io
