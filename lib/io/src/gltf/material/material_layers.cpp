#include "gltf/material/material.h"

#include <string>

namespace bdpt::io {

namespace {

ClearcoatDesc read_clearcoat(const MaterialExtension& from)
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

CoatDesc read_coat(const MaterialExtension& from)
{
    CoatDesc coat;
    coat.factor = from.number("coatFactor", 0.0, 0.0, 1.0);
    if (coat.factor == 0.0f) {
        return coat;  // all of it is off, also what the draft multiplies the base by
    }
    coat.texture = from.texture("coatTexture");
    coat.roughness = from.number("coatRoughnessFactor", 0.0, 0.0, 1.0);
    if (coat.roughness > 0.0f) {
        coat.roughness_texture = from.texture("coatRoughnessTexture");
    }
    // 0 stands for a Fresnel term of one, as in KHR_materials_ior.
    coat.ior = number_or(from.object, "coatIor", 1.5) == 0.0
                   ? static_cast<float>(no_limit)
                   : from.number("coatIor", 1.5, 1.0, no_limit);
    coat.color = from.color("coatColorFactor", 1.0);
    if (coat.color != Rgb(0.0f)) {
        coat.color_texture = from.texture("coatColorTexture");
    }
    coat.darkening = from.number("coatDarkeningFactor", 1.0, 0.0, 1.0);
    coat.anisotropy_strength = from.number("coatAnisotropyStrength", 0.0, 0.0, 1.0);
    if (coat.anisotropy_strength > 0.0f) {
        coat.anisotropy_rotation = from.number("coatAnisotropyRotation", 0.0, -no_limit, no_limit);
        coat.anisotropy_texture = from.texture("coatAnisotropyTexture");
    }
    coat.normal_texture = from.texture("coatNormalTexture");
    if (coat.normal_texture) {
        coat.normal_scale =
            static_cast<float>(number_or(from.object.Get("coatNormalTexture"), "scale", 1.0));
    }
    return coat;
}

SheenDesc read_sheen(const MaterialExtension& from)
{
    SheenDesc sheen;
    sheen.color = from.color("sheenColorFactor", 1.0, Rgb(0.0f));
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

/// The draft's text and schema differ in the default of the roughness: it is that of the text and
/// of OpenPBR, as in other readers.
FuzzDesc read_fuzz(const MaterialExtension& from)
{
    FuzzDesc fuzz;
    fuzz.factor = from.number("fuzzFactor", 0.0, 0.0, 1.0);
    if (fuzz.factor == 0.0f) {
        return fuzz;
    }
    fuzz.texture = from.texture("fuzzTexture");
    fuzz.color = from.color("fuzzColorFactor", 1.0);
    if (fuzz.color != Rgb(0.0f)) {
        fuzz.color_texture = from.texture("fuzzColorTexture");
    }
    fuzz.roughness = from.number("fuzzRoughnessFactor", 0.5, 0.0, 1.0);
    if (fuzz.roughness > 0.0f) {
        fuzz.roughness_texture = from.texture("fuzzRoughnessTexture");
    }
    return fuzz;
}

AnisotropyDesc read_anisotropy(const MaterialExtension& from)
{
    AnisotropyDesc anisotropy;
    anisotropy.strength = from.number("anisotropyStrength", 0.0, 0.0, 1.0);
    if (anisotropy.strength == 0.0f) {
        return anisotropy;
    }
    anisotropy.rotation = from.number("anisotropyRotation", 0.0, -no_limit, no_limit);
    anisotropy.texture = from.texture("anisotropyTexture");
    return anisotropy;
}

IridescenceDesc read_iridescence(const MaterialExtension& from)
{
    IridescenceDesc film;
    film.factor = from.number("iridescenceFactor", 0.0, 0.0, 1.0);
    if (film.factor == 0.0f) {
        return film;
    }
    film.ior = from.number("iridescenceIor", 1.3, 1.0, no_limit);
    film.thickness_minimum = from.number("iridescenceThicknessMinimum", 100.0, 0.0, no_limit);
    film.thickness_maximum = from.number("iridescenceThicknessMaximum", 400.0, 0.0, no_limit);
    film.texture = from.texture("iridescenceTexture");
    if (film.thickness_minimum != film.thickness_maximum) {
        film.thickness_texture = from.texture("iridescenceThicknessTexture");
    }
    return film;
}

DiffuseTransmissionDesc read_diffuse_transmission(const MaterialExtension& from)
{
    DiffuseTransmissionDesc through;
    through.factor = from.number("diffuseTransmissionFactor", 0.0, 0.0, 1.0);
    if (through.factor == 0.0f) {
        return through;
    }
    through.texture = from.texture("diffuseTransmissionTexture");
    through.color = from.color("diffuseTransmissionColorFactor", 1.0);
    if (through.color != Rgb(0.0f)) {
        through.color_texture = from.texture("diffuseTransmissionColorTexture");
    }
    return through;
}

/// Drafts differ in the default: it is that of OpenPBR, as in other readers.
DiffuseRoughnessDesc read_diffuse_roughness(const MaterialExtension& from)
{
    DiffuseRoughnessDesc rough;
    rough.factor = from.number("diffuseRoughnessFactor", 0.0, 0.0, 1.0);
    if (rough.factor > 0.0f) {
        rough.texture = from.texture("diffuseRoughnessTexture");
    }
    return rough;
}

float read_dispersion(const MaterialExtension& from)
{
    return from.number("dispersion", 0.0, 0.0, no_limit);
}

/// Returns the value that `read` makes of an extension, if the material has it.
template <typename Desc>
void read_extension(const MaterialValues& values, const std::string& name,
                    Desc (*read)(const MaterialExtension&), Desc& desc)
{
    if (const auto from = values.extension(name)) {
        desc = read(*from);
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
