#pragma once

#include <bdpt/io/gltf.h>

#include <cstddef>
#include <string_view>

namespace bdpt::io {

/// A property of a material's extension, for the check of its type: a number, or an array of them.
struct MaterialProperty {
    std::string_view path;       ///< within the extension
    std::size_t components = 1;  ///< 1: a number
};

/// Our support of one glTF extension.
struct ExtensionSupport {
    std::string_view name;
    std::string_view note = {};  ///< the loss, in a few words
    /// The properties of a material's extension, but textures; those after the last are empty.
    MaterialProperty properties[8] = {};
    ExtensionStatus status = ExtensionStatus::supported;
};

/// All extensions that we know. The loader, its checks and the reports use this table.
inline constexpr ExtensionSupport extension_table[] = {
    {"KHR_draco_mesh_compression", "where Draco is installed"},
    {"KHR_lights_punctual", "range is ignored"},
    {"KHR_materials_anisotropy", "", {{"anisotropyStrength"}, {"anisotropyRotation"}}},
    {"KHR_materials_clearcoat",
     "",
     {{"clearcoatFactor"}, {"clearcoatRoughnessFactor"}, {"clearcoatNormalTexture/scale"}}},
    {"KHR_materials_coat",
     "",
     {{"coatFactor"},
      {"coatRoughnessFactor"},
      {"coatIor"},
      {"coatColorFactor", 3},
      {"coatDarkeningFactor"},
      {"coatAnisotropyStrength"},
      {"coatAnisotropyRotation"},
      {"coatNormalTexture/scale"}},
     ExtensionStatus::draft},
    {"KHR_materials_diffuse_roughness", "", {{"diffuseRoughnessFactor"}}, ExtensionStatus::draft},
    {"KHR_materials_diffuse_transmission",
     "not combined with refraction",
     {{"diffuseTransmissionFactor"}, {"diffuseTransmissionColorFactor", 3}}},
    {"KHR_materials_dispersion", "one index for each channel", {{"dispersion"}}},
    {"KHR_materials_emissive_strength", "", {{"emissiveStrength"}}},
    {"KHR_materials_fuzz",
     "roughness is at least 0.1",
     {{"fuzzFactor"}, {"fuzzColorFactor", 3}, {"fuzzRoughnessFactor"}},
     ExtensionStatus::draft},
    {"KHR_materials_ior", "", {{"ior"}}},
    {"KHR_materials_iridescence",
     "",
     {{"iridescenceFactor"},
      {"iridescenceIor"},
      {"iridescenceThicknessMinimum"},
      {"iridescenceThicknessMaximum"}}},
    {"KHR_materials_pbrSpecularGlossiness",
     "",
     {{"diffuseFactor", 4}, {"specularFactor", 3}, {"glossinessFactor"}}},
    {"KHR_materials_scatter",
     "in bodies with a thickness only, without textures",
     {{"scatterStrengthFactor"}, {"multiscatterColorFactor", 3}, {"scatterAnisotropy"}},
     ExtensionStatus::draft},
    {"KHR_materials_sheen",
     "roughness is at least 0.1",
     {{"sheenColorFactor", 3}, {"sheenRoughnessFactor"}}},
    {"KHR_materials_specular", "", {{"specularFactor"}, {"specularColorFactor", 3}}},
    {"KHR_materials_transmission", "", {{"transmissionFactor"}}},
    {"KHR_materials_unlit", "emits its base colour"},
    {"KHR_materials_variants", "chosen by --variant"},
    {"KHR_materials_volume",
     "thickness only distinguishes solid from thin bodies",
     {{"thicknessFactor"}, {"attenuationDistance"}, {"attenuationColor", 3}}},
    {"KHR_materials_volume_scatter",
     "by random walks, so --max-depth limits them",
     {{"scatterAnisotropy"}, {"multiscatterColor", 3}, {"multiscatterColorFactor", 3}},
     ExtensionStatus::draft},
    {"KHR_mesh_quantization"},
    {"KHR_meshopt_compression", "where meshoptimizer is installed; not the filter COLOR"},
    {"KHR_node_visibility"},
    {"KHR_texture_basisu", "where libktx is installed"},
    {"KHR_texture_transform"},
    {"EXT_lights_ies", "TILT is ignored"},
    {"EXT_lights_image_based", "the largest images only; --env replaces it"},
    {"EXT_mesh_gpu_instancing"},
    {"EXT_meshopt_compression", "where meshoptimizer is installed"},
    {"EXT_texture_webp"},
    // Supported without any code: they do not influence an image.
    {"FB_ngon_encoding", "no influence on the image"},
    {"KHR_xmp", "metadata of the file are written into images"},
    {"KHR_xmp_json_ld", "metadata of the file are written into images"},
    {"KHR_animation_pointer", "properties of the core specification only"},
    {"MSFT_packing_normalRoughnessMetallic", "the core textures are used"},
    {"MSFT_packing_occlusionRoughnessMetallic", "the core textures are used"},
    {"MSFT_lod", "the finest level is shown"},
    // Without these the image lacks something.
    {"MSFT_texture_dds", "only fallback images are read", {}, ExtensionStatus::ignored},
    {"EXT_texture_avif", "only fallback images are read", {}, ExtensionStatus::ignored},
};

}  // namespace bdpt::io
