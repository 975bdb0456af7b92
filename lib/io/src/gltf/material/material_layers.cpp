#include "gltf/material/material.h"

#include <string>

namespace bdpt::io {

namespace {

/// Reads the factor of a layer and its texture; returns false if the factor is 0, when all of the
/// layer is off.
template <typename Desc>
bool read_factor(const MaterialExtension& from, const std::string& layer, Desc& desc)
{
    desc.factor = from.number(layer + "Factor", 0.0, 0.0, 1.0);
    if (desc.factor > 0.0f) {
        desc.texture = from.texture(layer + "Texture");
    }
    return desc.factor > 0.0f;
}

template <typename Desc>
void read_roughness(const MaterialExtension& from, const std::string& layer, double fallback,
                    Desc& desc)
{
    desc.roughness = from.number(layer + "RoughnessFactor", fallback, 0.0, 1.0);
    if (desc.roughness > 0.0f) {
        desc.roughness_texture = from.texture(layer + "RoughnessTexture");
    }
}

/// Reads a colour and its texture; returns false if it is black.
template <typename Desc>
bool read_color(const MaterialExtension& from, const std::string& layer, Rgb fallback, Desc& desc)
{
    desc.color = from.color(layer + "ColorFactor", 1.0, fallback);
    if (desc.color != Rgb(0.0f)) {
        desc.color_texture = from.texture(layer + "ColorTexture");
    }
    return desc.color != Rgb(0.0f);
}

template <typename Desc>
void read_normal(const MaterialExtension& from, const std::string& layer, Desc& desc)
{
    const std::string key = layer + "NormalTexture";
    desc.normal_texture = from.texture(key);
    if (desc.normal_texture) {
        desc.normal_scale = static_cast<float>(number_or(from.object.Get(key), "scale", 1.0));
    }
}

void read_clearcoat(const MaterialExtension& from, ClearcoatDesc& coat)
{
    if (read_factor(from, "clearcoat", coat)) {
        read_roughness(from, "clearcoat", 0.0, coat);
        read_normal(from, "clearcoat", coat);
    }
}

void read_coat(const MaterialExtension& from, CoatDesc& coat)
{
    if (!read_factor(from, "coat", coat)) {
        return;  // also what the draft multiplies the base by
    }
    read_roughness(from, "coat", 0.0, coat);
    // 0 stands for a Fresnel term of one, as in KHR_materials_ior.
    coat.ior = number_or(from.object, "coatIor", 1.5) == 0.0
                   ? static_cast<float>(no_limit)
                   : from.number("coatIor", 1.5, 1.0, no_limit);
    read_color(from, "coat", Rgb(1.0f), coat);
    coat.darkening = from.number("coatDarkeningFactor", 1.0, 0.0, 1.0);
    coat.anisotropy_strength = from.number("coatAnisotropyStrength", 0.0, 0.0, 1.0);
    if (coat.anisotropy_strength > 0.0f) {
        coat.anisotropy_rotation = from.number("coatAnisotropyRotation", 0.0, -no_limit, no_limit);
        coat.anisotropy_texture = from.texture("coatAnisotropyTexture");
    }
    read_normal(from, "coat", coat);
}

void read_sheen(const MaterialExtension& from, SheenDesc& sheen)
{
    if (read_color(from, "sheen", Rgb(0.0f), sheen)) {
        read_roughness(from, "sheen", 0.0, sheen);
    }
}

/// The draft's text and schema differ in the default of the roughness: it is that of the text and
/// of OpenPBR, as in other readers.
void read_fuzz(const MaterialExtension& from, FuzzDesc& fuzz)
{
    if (read_factor(from, "fuzz", fuzz)) {
        read_color(from, "fuzz", Rgb(1.0f), fuzz);
        read_roughness(from, "fuzz", 0.5, fuzz);
    }
}

void read_anisotropy(const MaterialExtension& from, AnisotropyDesc& anisotropy)
{
    anisotropy.strength = from.number("anisotropyStrength", 0.0, 0.0, 1.0);
    if (anisotropy.strength > 0.0f) {
        anisotropy.rotation = from.number("anisotropyRotation", 0.0, -no_limit, no_limit);
        anisotropy.texture = from.texture("anisotropyTexture");
    }
}

void read_iridescence(const MaterialExtension& from, IridescenceDesc& film)
{
    if (!read_factor(from, "iridescence", film)) {
        return;
    }
    film.ior = from.number("iridescenceIor", 1.3, 1.0, no_limit);
    film.thickness_minimum = from.number("iridescenceThicknessMinimum", 100.0, 0.0, no_limit);
    film.thickness_maximum = from.number("iridescenceThicknessMaximum", 400.0, 0.0, no_limit);
    if (film.thickness_minimum != film.thickness_maximum) {
        film.thickness_texture = from.texture("iridescenceThicknessTexture");
    }
}

void read_diffuse_transmission(const MaterialExtension& from, DiffuseTransmissionDesc& through)
{
    if (read_factor(from, "diffuseTransmission", through)) {
        read_color(from, "diffuseTransmission", Rgb(1.0f), through);
    }
}

/// Drafts differ in the default: it is that of OpenPBR, as in other readers.
void read_diffuse_roughness(const MaterialExtension& from, DiffuseRoughnessDesc& rough)
{
    read_factor(from, "diffuseRoughness", rough);
}

void read_dispersion(const MaterialExtension& from, float& dispersion)
{
    dispersion = from.number("dispersion", 0.0, 0.0, no_limit);
}

/// Reads an extension, if the material has it.
template <typename Desc>
void read_extension(const MaterialValues& values, const std::string& name,
                    void (*read)(const MaterialExtension&, Desc&), Desc& desc)
{
    if (const auto from = values.extension(name)) {
        read(*from, desc);
    }
}

}  // namespace

void read_layers(const MaterialValues& values, MaterialDesc& desc)
{
    // A layer that another replaces, even by none, is a fallback for readers without the draft.
    if (values.extension("KHR_materials_coat")) {
        read_extension(values, "KHR_materials_coat", read_coat, desc.coat);
    } else {
        read_extension(values, "KHR_materials_clearcoat", read_clearcoat, desc.clearcoat);
    }
    if (values.extension("KHR_materials_fuzz")) {
        read_extension(values, "KHR_materials_fuzz", read_fuzz, desc.fuzz);
    } else {
        read_extension(values, "KHR_materials_sheen", read_sheen, desc.sheen);
    }
    read_extension(values, "KHR_materials_anisotropy", read_anisotropy, desc.anisotropy);
    read_extension(values, "KHR_materials_iridescence", read_iridescence, desc.iridescence);
    read_extension(values, "KHR_materials_diffuse_transmission", read_diffuse_transmission,
                   desc.diffuse_transmission);
    read_extension(values, "KHR_materials_diffuse_roughness", read_diffuse_roughness,
                   desc.diffuse_roughness);
    read_extension(values, "KHR_materials_dispersion", read_dispersion, desc.dispersion);
}

}  // namespace bdpt::io
