#pragma once

/// @file
/// Describes the materials of a scene.
///
/// @code{.cpp}
/// bdpt::MaterialDesc glass;
/// glass.name = "glass";
/// glass.metallic = 0.0f;
/// glass.roughness = 0.0f;
/// glass.transmission = 1.0f;
/// glass.thickness = 0.01f;  // the mesh bounds a solid body
/// bdpt::SceneBuilder builder;
/// builder.place(builder.add(bdpt::sphere_mesh(0.5f)), builder.add(glass));
/// @endcode

#include <bdpt/export.h>
#include <bdpt/fields.h>
#include <bdpt/medium_desc.h>
#include <bdpt/scene_ids.h>
#include <bdpt/types.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>

namespace bdpt {

/// Texture lookup outside of [0, 1]; names as in glTF 2.0.
enum class Wrap : std::uint8_t { repeat, mirrored_repeat, clamp_to_edge };

/// An image used by a material slot, with the transform of KHR_texture_transform.
struct TextureRef {
    ImageId image{};
    int uv_set = 0;  ///< 0 or 1
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
    Vec2 offset{0.0f};
    float rotation = 0.0f;  ///< [rad], counter-clockwise
    Vec2 scale{1.0f};
};

/// The effect of alpha, the product of base_color.a, the texture's and the vertex colour's alpha,
/// on a surface [glTF 2.0, sec. 3.9.4].
enum class AlphaMode : std::uint8_t {
    opaque,  ///< alpha is ignored
    mask,    ///< the surface exists where alpha is at least `alpha_cutoff`
    /// Alpha is the fraction of light that hits the surface; the rest passes straight through.
    blend,
};

/// Clear varnish over everything else, of index 1.5 [KHR_materials_clearcoat].
struct ClearcoatDesc {
    float factor = 0.0f;     ///< [0, 1], fraction of the surface that is coated; 0: no coat
    float roughness = 0.0f;  ///< [0, 1], perceptual
    float normal_scale = 1.0f;
    std::optional<TextureRef> texture;            ///< linear; R, times factor
    std::optional<TextureRef> roughness_texture;  ///< linear; G, times roughness
    /// Linear; none: normals of the coat are not perturbed.
    std::optional<TextureRef> normal_texture;
};

/// A coat of any dielectric over everything but fuzz, such as tinted lacquer [KHR_materials_coat, a
/// draft]. It replaces a clearcoat, of which it is the general case.
struct CoatDesc {
    float factor = 0.0f;     ///< [0, 1], fraction of the surface that is coated; 0: no coat
    float roughness = 0.0f;  ///< [0, 1], perceptual; also blurs the reflection of the base
    float ior = 1.5f;        ///< >= 1
    Rgb color{1.0f};         ///< [0, 1], of light that passes straight through and back
    /// [0, 1], how much light that the coat reflects back inside darkens a coloured base.
    float darkening = 1.0f;
    float anisotropy_strength = 0.0f;  ///< [0, 1]; 0: round highlights
    float anisotropy_rotation = 0.0f;  ///< of the blur, from the tangent to the bitangent [rad]
    float normal_scale = 1.0f;
    std::optional<TextureRef> texture;            ///< linear; R, times factor
    std::optional<TextureRef> roughness_texture;  ///< linear; G, times roughness
    std::optional<TextureRef> color_texture;      ///< sRGB
    /// Linear; RG direction, B times anisotropy_strength.
    std::optional<TextureRef> anisotropy_texture;
    std::optional<TextureRef> normal_texture;  ///< linear; none: normals are not perturbed
};

/// Fibres on top of a cloth, above everything but a coat [KHR_materials_sheen].
struct SheenDesc {
    Rgb color{0.0f};                              ///< [0, 1], also their density; black: no sheen
    float roughness = 0.0f;                       ///< [0, 1]
    std::optional<TextureRef> color_texture;      ///< sRGB
    std::optional<TextureRef> roughness_texture;  ///< linear; A
};

/// Fibres or dust on top of everything, such as black velvet [KHR_materials_fuzz, a draft]. They
/// replace a sheen.
struct FuzzDesc {
    float factor = 0.0f;  ///< [0, 1], fraction of the surface with fibres; 0: none
    Rgb color{1.0f};      ///< [0, 1]
    /// [0, 1], from upright fibres to dust, which covers more; at least 0.1 counts.
    float roughness = 0.5f;
    std::optional<TextureRef> texture;            ///< linear; R, times factor
    std::optional<TextureRef> color_texture;      ///< sRGB
    std::optional<TextureRef> roughness_texture;  ///< linear; A
};

/// Grooves that blur reflections along one direction [KHR_materials_anisotropy].
struct AnisotropyDesc {
    float strength = 0.0f;  ///< [0, 1]; 0: round highlights
    /// Rotation of the blur direction from the tangent to the bitangent [rad].
    float rotation = 0.0f;
    std::optional<TextureRef> texture;  ///< linear; RG direction, B times strength
};

/// A thin film whose interference colours reflections [KHR_materials_iridescence].
struct IridescenceDesc {
    float factor = 0.0f;               ///< [0, 1]; 0: no film
    float ior = 1.3f;                  ///< index of refraction of the film, >= 1
    float thickness_minimum = 100.0f;  ///< thickness where the texture is 0 [nm]
    /// Thickness where the texture is 1, or without a texture [nm].
    float thickness_maximum = 400.0f;
    std::optional<TextureRef> texture;            ///< linear; R, times factor
    std::optional<TextureRef> thickness_texture;  ///< linear; G
};

/// Diffuse light transmitted to the other side, as through paper or a leaf
/// [KHR_materials_diffuse_transmission].
struct DiffuseTransmissionDesc {
    float factor = 0.0f;                      ///< [0, 1], transmitted fraction of the diffuse light
    Rgb color{1.0f};                          ///< [0, 1]
    std::optional<TextureRef> texture;        ///< linear; A, times factor
    std::optional<TextureRef> color_texture;  ///< sRGB
};

/// Roughness of the diffuse base, such as that of clay or sandstone, which makes it look flatter
/// [KHR_materials_diffuse_roughness, a draft]. The mean albedo stays the base colour.
struct DiffuseRoughnessDesc {
    float factor = 0.0f;                ///< [0, 1]; 0: Lambertian
    std::optional<TextureRef> texture;  ///< linear; R, times factor
};

/// Scattering within a body, whose attenuation sets the density [KHR_materials_volume_scatter and
/// KHR_materials_scatter, drafts].
struct VolumeScatterDesc {
    /// Multiple-scattering albedo, [0, 1]: approximately the colour of a dense body.
    Rgb color{0.0f};
    float anisotropy = 0.0f;  ///< g of Henyey and Greenstein, in (-1, 1); > 0 scatters forwards
};

/// glTF 2.0 metallic-roughness material with KHR_materials_{anisotropy, clearcoat, coat,
/// diffuse_roughness, diffuse_transmission, dispersion, emissive_strength, fuzz, iridescence, ior,
/// sheen, specular, transmission, volume, volume_scatter, unlit}; names, defaults and ranges are
/// those of the specification [glTF 2.0, sec. 3.9; KHR extensions of these names].
struct MaterialDesc {
    std::string name{};
    Vec4 base_color{1.0f};  ///< [0, 1]
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f;  ///< >= 0
    /// Emits its base colour as radiance [nit] and scatters nothing: a light like any other. Only
    /// base colour, alpha and `double_sided` have an effect.
    bool unlit = false;
    float metallic = 1.0f;      ///< [0, 1]
    float roughness = 1.0f;     ///< [0, 1], perceptual; GGX alpha is its square; 0: a mirror
    Rgb emission{0.0f};         ///< radiance [nit], >= 0
    float normal_scale = 1.0f;  ///< scales x and y of normal_texture
    bool double_sided = false;  ///< emits from both sides; scattering is two-sided in any case

    float ior = 1.5f;           ///< >= 1
    float specular = 1.0f;      ///< [0, 1]; 0 removes the dielectric reflection
    Rgb specular_color{1.0f};   ///< >= 0, factor of the reflectance at normal incidence
    float transmission = 0.0f;  ///< [0, 1]
    float thickness = 0.0f;     ///< > 0: the mesh bounds a solid body; 0: a thin sheet
    float attenuation_distance = std::numeric_limits<float>::infinity();  ///< [m], > 0
    Rgb attenuation_color{1.0f};  ///< [0, 1], transmitted colour of white light after that distance
    float dispersion = 0.0f;      ///< >= 0, 20 / Abbe number of a solid transmitter

    ClearcoatDesc clearcoat{};
    BDPT_EXPERIMENTAL CoatDesc coat{};
    SheenDesc sheen{};
    BDPT_EXPERIMENTAL FuzzDesc fuzz{};
    AnisotropyDesc anisotropy{};
    IridescenceDesc iridescence{};
    DiffuseTransmissionDesc diffuse_transmission{};
    BDPT_EXPERIMENTAL DiffuseRoughnessDesc diffuse_roughness{};
    BDPT_EXPERIMENTAL VolumeScatterDesc volume_scatter{};

    std::optional<TextureRef> base_color_texture;          ///< sRGB, times base_color
    std::optional<TextureRef> metallic_roughness_texture;  ///< linear; G roughness, B metallic
    std::optional<TextureRef> normal_texture;              ///< linear, tangent space
    std::optional<TextureRef> emission_texture;            ///< sRGB, times emission
    std::optional<TextureRef> specular_texture;            ///< linear; A
    std::optional<TextureRef> specular_color_texture;      ///< sRGB
    std::optional<TextureRef> transmission_texture;        ///< linear; R
    std::optional<TextureRef> glossiness_texture;          ///< linear; A, times 1 - roughness
};
/// Fields of `TextureRef`, with names and limits.
template <>
inline constexpr auto fields<TextureRef> = all_fields(Field{"image", &TextureRef::image},
                                                      Field{"uv set", &TextureRef::uv_set},
                                                      Field{"wrap u", &TextureRef::wrap_u},
                                                      Field{"wrap v", &TextureRef::wrap_v},
                                                      Field{"offset", &TextureRef::offset},
                                                      Field{"rotation", &TextureRef::rotation},
                                                      Field{"scale", &TextureRef::scale});
/// Fields of `ClearcoatDesc`, with names and limits.
template <>
inline constexpr auto fields<ClearcoatDesc> =
    all_fields(Number{"clearcoat", &ClearcoatDesc::factor, Limits::unit()},
               Number{"clearcoat roughness", &ClearcoatDesc::roughness, Limits::unit()},
               Number{"clearcoat normal scale", &ClearcoatDesc::normal_scale, Limits::finite()},
               Field{"clearcoat texture", &ClearcoatDesc::texture},
               Field{"clearcoat roughness texture", &ClearcoatDesc::roughness_texture},
               Field{"clearcoat normal texture", &ClearcoatDesc::normal_texture});
/// Fields of `CoatDesc`, with names and limits.
template <>
inline constexpr auto fields<CoatDesc> =
    all_fields(Number{"coat", &CoatDesc::factor, Limits::unit()},
               Number{"coat roughness", &CoatDesc::roughness, Limits::unit()},
               Number{"coat index of refraction", &CoatDesc::ior, Limits::at_least(1.0f)},
               Number{"coat colour", &CoatDesc::color, Limits::unit()},
               Number{"coat darkening", &CoatDesc::darkening, Limits::unit()},
               Number{"coat anisotropy strength", &CoatDesc::anisotropy_strength, Limits::unit()},
               Number{"coat anisotropy rotation", &CoatDesc::anisotropy_rotation, Limits::finite()},
               Number{"coat normal scale", &CoatDesc::normal_scale, Limits::finite()},
               Field{"coat texture", &CoatDesc::texture},
               Field{"coat roughness texture", &CoatDesc::roughness_texture},
               Field{"coat colour texture", &CoatDesc::color_texture},
               Field{"coat anisotropy texture", &CoatDesc::anisotropy_texture},
               Field{"coat normal texture", &CoatDesc::normal_texture});
/// Fields of `SheenDesc`, with names and limits.
template <>
inline constexpr auto fields<SheenDesc> =
    all_fields(Number{"sheen colour", &SheenDesc::color, Limits::unit()},
               Number{"sheen roughness", &SheenDesc::roughness, Limits::unit()},
               Field{"sheen colour texture", &SheenDesc::color_texture},
               Field{"sheen roughness texture", &SheenDesc::roughness_texture});
/// Fields of `FuzzDesc`, with names and limits.
template <>
inline constexpr auto fields<FuzzDesc> =
    all_fields(Number{"fuzz", &FuzzDesc::factor, Limits::unit()},
               Number{"fuzz colour", &FuzzDesc::color, Limits::unit()},
               Number{"fuzz roughness", &FuzzDesc::roughness, Limits::unit()},
               Field{"fuzz texture", &FuzzDesc::texture},
               Field{"fuzz colour texture", &FuzzDesc::color_texture},
               Field{"fuzz roughness texture", &FuzzDesc::roughness_texture});
/// Fields of `AnisotropyDesc`, with names and limits.
template <>
inline constexpr auto fields<AnisotropyDesc> =
    all_fields(Number{"anisotropy strength", &AnisotropyDesc::strength, Limits::unit()},
               Number{"anisotropy rotation", &AnisotropyDesc::rotation, Limits::finite()},
               Field{"anisotropy texture", &AnisotropyDesc::texture});
/// Fields of `IridescenceDesc`, with names and limits.
template <>
inline constexpr auto fields<IridescenceDesc> = all_fields(
    Number{"iridescence", &IridescenceDesc::factor, Limits::unit()},
    Number{"iridescence index of refraction", &IridescenceDesc::ior, Limits::at_least(1.0f)},
    Number{"iridescence thickness minimum", &IridescenceDesc::thickness_minimum,
           Limits::at_least(0.0f)},
    Number{"iridescence thickness maximum", &IridescenceDesc::thickness_maximum,
           Limits::at_least(0.0f)},
    Field{"iridescence texture", &IridescenceDesc::texture},
    Field{"iridescence thickness texture", &IridescenceDesc::thickness_texture});
/// Fields of `DiffuseTransmissionDesc`, with names and limits.
template <>
inline constexpr auto fields<DiffuseTransmissionDesc> = all_fields(
    Number{"diffuse transmission", &DiffuseTransmissionDesc::factor, Limits::unit()},
    Number{"diffuse transmission colour", &DiffuseTransmissionDesc::color, Limits::unit()},
    Field{"diffuse transmission texture", &DiffuseTransmissionDesc::texture},
    Field{"diffuse transmission colour texture", &DiffuseTransmissionDesc::color_texture});
/// Fields of `DiffuseRoughnessDesc`, with names and limits.
template <>
inline constexpr auto fields<DiffuseRoughnessDesc> =
    all_fields(Number{"diffuse roughness", &DiffuseRoughnessDesc::factor, Limits::unit()},
               Field{"diffuse roughness texture", &DiffuseRoughnessDesc::texture});
/// Fields of `VolumeScatterDesc`, with names and limits.
template <>
inline constexpr auto fields<VolumeScatterDesc> =
    all_fields(Number{"multi-scatter colour", &VolumeScatterDesc::color, Limits::unit()},
               Number{"scatter anisotropy", &VolumeScatterDesc::anisotropy,
                      Limits{-max_anisotropy, max_anisotropy}});
/// Fields of `MaterialDesc`, with names and limits.
template <>
inline constexpr auto fields<MaterialDesc> = all_fields(
    Field{"name", &MaterialDesc::name},  //
    Number{"base colour", &MaterialDesc::base_color, Limits::unit()},
    Field{"alpha mode", &MaterialDesc::alpha_mode},
    Number{"alpha cutoff", &MaterialDesc::alpha_cutoff, Limits::at_least(0.0f)},
    Field{"unlit", &MaterialDesc::unlit},
    Number{"metallic", &MaterialDesc::metallic, Limits::unit()},
    Number{"roughness", &MaterialDesc::roughness, Limits::unit()},
    Number{"emission", &MaterialDesc::emission, Limits::at_least(0.0f)},
    Number{"normal scale", &MaterialDesc::normal_scale, Limits::finite()},
    Field{"double sided", &MaterialDesc::double_sided},
    Number{"index of refraction", &MaterialDesc::ior, Limits::at_least(1.0f)},
    Number{"specular", &MaterialDesc::specular, Limits::unit()},
    Number{"specular colour", &MaterialDesc::specular_color, Limits::at_least(0.0f)},
    Number{"transmission", &MaterialDesc::transmission, Limits::unit()},
    Number{"thickness", &MaterialDesc::thickness, Limits::at_least(0.0f)},
    Number{"attenuation distance", &MaterialDesc::attenuation_distance, Limits::above(0.0f)},
    Number{"attenuation colour", &MaterialDesc::attenuation_color, Limits::unit()},
    Number{"dispersion", &MaterialDesc::dispersion, Limits::at_least(0.0f)},
    Field{"clearcoat", &MaterialDesc::clearcoat}, Field{"coat", &MaterialDesc::coat},
    Field{"sheen", &MaterialDesc::sheen}, Field{"fuzz", &MaterialDesc::fuzz},
    Field{"anisotropy", &MaterialDesc::anisotropy},
    Field{"iridescence", &MaterialDesc::iridescence},
    Field{"diffuse transmission", &MaterialDesc::diffuse_transmission},
    Field{"diffuse roughness", &MaterialDesc::diffuse_roughness},
    Field{"volume scatter", &MaterialDesc::volume_scatter},
    Field{"base colour texture", &MaterialDesc::base_color_texture},
    Field{"metallic roughness texture", &MaterialDesc::metallic_roughness_texture},
    Field{"normal texture", &MaterialDesc::normal_texture},
    Field{"emission texture", &MaterialDesc::emission_texture},
    Field{"specular texture", &MaterialDesc::specular_texture},
    Field{"specular colour texture", &MaterialDesc::specular_color_texture},
    Field{"transmission texture", &MaterialDesc::transmission_texture},
    Field{"glossiness texture", &MaterialDesc::glossiness_texture});

/// Calls `visit(texture)` with each `std::optional<TextureRef>` of `desc`, then with those of its
/// layers.
template <HasFields Desc, typename Visitor>
constexpr void for_each_texture(Desc& desc, const Visitor& visit)
{
    for_each_field(desc, [&visit](const auto& /*field*/, auto& value) {
        using T = std::remove_cvref_t<decltype(value)>;
        if constexpr (std::is_same_v<T, std::optional<TextureRef>>) {
            visit(value);
        }
    });
    for_each_field(desc, [&visit](const auto& /*field*/, auto& value) {
        if constexpr (HasFields<decltype(value)>) {
            for_each_texture(value, visit);
        }
    });
}

}  // namespace bdpt
