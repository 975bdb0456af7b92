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

std::optional<MaterialExtension> MaterialValues::extension(const std::string& name) const
{
    const auto found = source_.extensions.find(name);
    if (found == source_.extensions.end()) {
        return std::nullopt;
    }
    return MaterialExtension{*this, found->second, "extensions/" + name};
}

std::optional<TextureRef> MaterialValues::texture(const TextureInfo& info,
                                                  std::string_view key) const
{
    return textures_.resolve(info, fmt::format("{}/{}", place_, key));
}

std::string MaterialExtension::at(std::string_view key) const
{
    return fmt::format("{}/{}", place, key);
}

float MaterialExtension::number(const std::string& key, double fallback, double low,
                                double high) const
{
    return values.in_range(number_or(object, key, fallback), low, high, at(key));
}

Rgb MaterialExtension::color(const std::string& key, double high, Rgb fallback) const
{
    if (!object.Has(key)) {
        return fallback;
    }
    const auto& numbers = object.Get(key).Get<tinygltf::Value::Array>();
    Rgb rgb;
    for (int c = 0; c < 3; ++c) {
        rgb[c] = values.in_range(numbers[static_cast<std::size_t>(c)].GetNumberAsDouble(), 0.0,
                                 high, key);
    }
    return rgb;
}

std::optional<TextureRef> MaterialExtension::texture(const std::string& key) const
{
    return values.texture(texture_info(object, key), at(key));
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
          context_(context),
          values_(source, place_, textures, context)
    {}

    [[nodiscard]] MaterialDesc read()
    {
        desc_.name = source_.name;
        desc_.double_sided = source_.doubleSided;
        read_base_color();
        read_alpha();
        const auto specular_glossiness = values_.extension("KHR_materials_pbrSpecularGlossiness");
        if (specular_glossiness) {
            read_specular_glossiness(*specular_glossiness);
        }
        if (values_.extension("KHR_materials_unlit")) {
            desc_.unlit = true;  // the rest is for viewers that do not know the extension
            return std::move(desc_);
        }
        read_emission();
        if (!specular_glossiness) {
            read_metallic_roughness();
            read_extension("KHR_materials_ior", &MaterialReader::read_ior);
            read_extension("KHR_materials_specular", &MaterialReader::read_specular);
        }
        read_extension("KHR_materials_transmission", &MaterialReader::read_transmission);
        read_extension("KHR_materials_volume", &MaterialReader::read_volume);
        read_extension("KHR_materials_volume_scatter", &MaterialReader::read_volume_scatter);
        read_extension("KHR_materials_scatter", &MaterialReader::read_scatter);
        read_layers(values_, desc_);
        for (const char* layer : {"KHR_materials_coat", "KHR_materials_fuzz"}) {
            if (specular_glossiness && values_.extension(layer)) {
                context_.warn(std::string(layer) +
                                  " must not be combined with "
                                  "KHR_materials_pbrSpecularGlossiness; both are used",
                              place_);
            }
        }
        if (source_.normalTexture.index >= 0) {
            desc_.normal_scale = static_cast<float>(source_.normalTexture.scale);
            desc_.normal_texture =
                values_.texture(texture_info(source_.normalTexture), "normalTexture");
        }
        return std::move(desc_);
    }

private:
    void read_extension(const char* name, void (MaterialReader::*read)(const MaterialExtension&))
    {
        if (const auto from = values_.extension(name)) {
            (this->*read)(*from);
        }
    }

    void read_base_color()
    {
        const auto& pbr = source_.pbrMetallicRoughness;
        for (int c = 0; c < 4; ++c) {
            desc_.base_color[c] =
                values_.in_range(pbr.baseColorFactor[static_cast<std::size_t>(c)], 0.0, 1.0,
                                 "pbrMetallicRoughness/baseColorFactor");
        }
        desc_.base_color_texture = values_.texture(texture_info(pbr.baseColorTexture),
                                                   "pbrMetallicRoughness/baseColorTexture");
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
                values_.texture(texture_info(pbr.metallicRoughnessTexture),
                                "pbrMetallicRoughness/metallicRoughnessTexture");
        }
    }

    /// Converts KHR_materials_pbrSpecularGlossiness to metallic-roughness: a dielectric of index
    /// 1.5 whose reflectance at normal incidence is the specular colour. It replaces base colour,
    /// metallic and roughness.
    void read_specular_glossiness(const MaterialExtension& from)
    {
        desc_.base_color = Vec4(1.0f);
        if (from.object.Has("diffuseFactor")) {
            const auto& factor = from.object.Get("diffuseFactor").Get<tinygltf::Value::Array>();
            for (int c = 0; c < 4; ++c) {
                desc_.base_color[c] =
                    values_.in_range(factor[static_cast<std::size_t>(c)].GetNumberAsDouble(), 0.0,
                                     1.0, from.at("diffuseFactor"));
            }
        }
        desc_.base_color_texture = from.texture("diffuseTexture");
        desc_.metallic = 0.0f;
        desc_.metallic_roughness_texture.reset();
        desc_.roughness = 1.0f - from.number("glossinessFactor", 1.0, 0.0, 1.0);
        // Reflectance of index 1.5, which the specular colour multiplies.
        constexpr float reflectance = 0.04f;
        const Rgb specular = from.color("specularFactor", 1.0);
        desc_.ior = 1.5f;
        desc_.specular = 1.0f;
        desc_.specular_color = specular / reflectance;
        const auto texture = from.texture("specularGlossinessTexture");
        if (specular != Rgb(0.0f)) {
            desc_.specular_color_texture = texture;
        }
        if (desc_.roughness < 1.0f) {
            desc_.glossiness_texture = texture;
        }
    }

    void read_emission()
    {
        double strength = 1.0;
        if (const auto from = values_.extension("KHR_materials_emissive_strength")) {
            strength = from->number("emissiveStrength", 1.0, 0.0, no_limit);
        }
        for (int c = 0; c < 3; ++c) {
            const double factor = source_.emissiveFactor[static_cast<std::size_t>(c)];
            // Factors above 1 were common before the extension for emissive strength.
            desc_.emission[c] = values_.in_range(
                values_.in_range(factor, 0.0, no_limit, "emissiveFactor") * strength, 0.0, no_limit,
                "emissiveFactor");
        }
        if (desc_.emission != Rgb(0.0f)) {
            desc_.emission_texture =
                values_.texture(texture_info(source_.emissiveTexture), "emissiveTexture");
        }
    }

    void read_ior(const MaterialExtension& from)
    {
        // 0 stands for a Fresnel term of one, that of an infinite index [KHR_materials_ior].
        constexpr float nearly_infinite = 1e4f;
        desc_.ior = number_or(from.object, "ior", 1.5) == 0.0
                        ? nearly_infinite
                        : from.number("ior", 1.5, 1.0, no_limit);
    }

    void read_specular(const MaterialExtension& from)
    {
        desc_.specular = from.number("specularFactor", 1.0, 0.0, 1.0);
        desc_.specular_color = from.color("specularColorFactor", no_limit);
        if (desc_.specular > 0.0f) {
            desc_.specular_texture = from.texture("specularTexture");
            desc_.specular_color_texture = from.texture("specularColorTexture");
        }
    }

    void read_transmission(const MaterialExtension& from)
    {
        desc_.transmission = from.number("transmissionFactor", 0.0, 0.0, 1.0);
        if (desc_.transmission > 0.0f) {
            desc_.transmission_texture = from.texture("transmissionTexture");
        }
    }

    void read_volume(const MaterialExtension& from)
    {
        desc_.thickness = from.number("thicknessFactor", 0.0, 0.0, no_limit);
        desc_.attenuation_color = from.color("attenuationColor", 1.0);
        if (!from.object.Has("attenuationDistance")) {
            return;
        }
        const double distance = from.object.Get("attenuationDistance").GetNumberAsDouble();
        if (static_cast<float>(distance) > 0.0f) {
            desc_.attenuation_distance = static_cast<float>(distance);
        } else {
            context_.warn(
                "an attenuation distance must be above 0; there is no attenuation",
                fmt::format("{}/{}: {}", place_, from.at("attenuationDistance"), distance));
        }
    }

    [[nodiscard]] static float scatter_anisotropy(const MaterialExtension& from)
    {
        constexpr auto most = static_cast<double>(max_anisotropy);
        return from.number("scatterAnisotropy", 0.0, -most, most);
    }

    /// Reads the draft of September 2025; older files call the colour a factor.
    void read_volume_scatter(const MaterialExtension& from)
    {
        const char* color =
            from.object.Has("multiscatterColor") ? "multiscatterColor" : "multiscatterColorFactor";
        desc_.volume_scatter.color = from.color(color, 1.0, Rgb(0.0f));
        desc_.volume_scatter.anisotropy = scatter_anisotropy(from);
    }

    /// Reads the draft of June 2026, the successor of KHR_materials_volume_scatter. Called after
    /// the volume is read.
    void read_scatter(const MaterialExtension& from)
    {
        const float strength = from.number("scatterStrengthFactor", 0.0, 0.0, 1.0);
        if (strength == 0.0f) {
            desc_.volume_scatter = {};
            return;
        }
        if (desc_.thickness == 0.0f) {
            context_.warn(WarningKind::loss,
                          "KHR_materials_scatter is supported in bodies with a thickness only; "
                          "this sheet does not scatter",
                          fmt::format("{}/{}", place_, from.at("scatterStrengthFactor")));
            return;
        }
        for (const char* texture : {"scatterStrengthTexture", "multiscatterColorTexture"}) {
            if (from.object.Has(texture)) {
                context_.warn(WarningKind::loss, "textures of KHR_materials_scatter are ignored",
                              fmt::format("{}/{}", place_, from.at(texture)));
            }
        }
        desc_.volume_scatter = {.color = strength * from.color("multiscatterColorFactor", 1.0),
                                .anisotropy = scatter_anisotropy(from)};
    }

    const tinygltf::Material& source_;
    std::string place_;
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
