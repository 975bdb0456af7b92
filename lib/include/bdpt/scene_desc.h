#pragma once

#include <bdpt/image.h>
#include <bdpt/types.h>

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace bdpt {

/// Index into `SceneDesc::meshes`. Each kind of index is a type, so that one cannot stand for
/// another.
enum class MeshId : std::uint32_t {};
/// Index into `SceneDesc::materials`.
enum class MaterialId : std::uint32_t {};
/// Index into `SceneDesc::images`.
enum class ImageId : std::uint32_t {};
/// Index into `SceneDesc::profiles`.
enum class ProfileId : std::uint32_t {};

// What moves while the shutter is open has a `motion` or `turn`: its values at equally spaced later
// moments, the last one when the shutter closes; the first value is that of the opening. Straight
// lines join them (bdpt/motion.h). Empty: it stands still.

/// The vertices of a mesh at a later moment: as many of each as the mesh has.
struct MeshPose {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;
    std::vector<Vec4> tangents;
};

/// Triangles with one material, in object space [m].
struct MeshDesc {
    std::string name{};
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;   ///< empty: use face normals
    std::vector<Vec4> tangents;  ///< xyz and handedness (+1, -1); empty: derived from uvs[0]
    std::array<std::vector<Vec2>, 2> uvs;  ///< empty: all (0, 0); v grows downwards (glTF)
    std::vector<Vec4> colors;        ///< linear RGBA that multiplies the base colour; empty: white
    std::vector<UVec3> triangles;    ///< counter-clockwise from the front
    std::vector<MeshPose> motion{};  ///< of a mesh that deforms
};

/// What a texture shows outside of [0, 1]; names as in glTF 2.0.
enum class Wrap : std::uint8_t { repeat, mirrored_repeat, clamp_to_edge };

/// How textures are looked up where they have more detail than the picture shows.
enum class TextureFilter : std::uint8_t {
    /// Between the texels of the picture as it is: many samples a pixel find the average.
    bilinear,
    /// Between those of a smaller copy, where texels are narrower than half a pixel seen directly
    /// from the camera: the same for all paths that meet the point. Emission, alpha, normals and
    /// directions are looked up as they are.
    mip_mapped,
};

/// A picture used by a material slot, with the transform of KHR_texture_transform.
struct TextureRef {
    ImageId image{};
    int uv_set = 0;  ///< 0 or 1
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
    Vec2 offset{0.0f};
    float rotation = 0.0f;  ///< [rad], counter-clockwise
    Vec2 scale{1.0f};
};

/// What alpha, that is base_color.a times the texture's and the vertex colour's, does to a surface
/// [glTF 2.0, sec. 3.9.4].
enum class AlphaMode : std::uint8_t {
    opaque,  ///< nothing
    mask,    ///< the surface is there where alpha is at least `alpha_cutoff`
    blend,   ///< alpha is the share of light that meets the surface; the rest passes straight on
};

/// Clear varnish over everything else, of index 1.5 [KHR_materials_clearcoat].
struct ClearcoatDesc {
    float factor = 0.0f;     ///< [0, 1], share of the surface that is coated; 0: no coat
    float roughness = 0.0f;  ///< [0, 1], perceptual
    float normal_scale = 1.0f;
    std::optional<TextureRef> texture;            ///< linear; R, times factor
    std::optional<TextureRef> roughness_texture;  ///< linear; G, times roughness
    std::optional<TextureRef> normal_texture;     ///< linear; none: the coat is even
};

/// Fibres that stand off a cloth, over everything but a coat [KHR_materials_sheen].
struct SheenDesc {
    Rgb color{0.0f};                              ///< [0, 1]; black: no sheen
    float roughness = 0.0f;                       ///< [0, 1]
    std::optional<TextureRef> color_texture;      ///< sRGB
    std::optional<TextureRef> roughness_texture;  ///< linear; A
};

/// Grooves that blur reflections along one direction [KHR_materials_anisotropy].
struct AnisotropyDesc {
    float strength = 0.0f;  ///< [0, 1]; 0: round highlights
    float rotation = 0.0f;  ///< [rad] of the direction of blur, from the tangent to the bitangent
    std::optional<TextureRef> texture;  ///< linear; RG direction, B times strength
};

/// A thin film whose interference colours reflections [KHR_materials_iridescence].
struct IridescenceDesc {
    float factor = 0.0f;                          ///< [0, 1]; 0: no film
    float ior = 1.3f;                             ///< >= 1, of the film
    float thickness_minimum = 100.0f;             ///< [nm], where the texture is 0
    float thickness_maximum = 400.0f;             ///< [nm], where it is 1, or without it
    std::optional<TextureRef> texture;            ///< linear; R, times factor
    std::optional<TextureRef> thickness_texture;  ///< linear; G
};

/// Matt light that comes out on the other side, as through paper or a leaf
/// [KHR_materials_diffuse_transmission].
struct DiffuseTransmissionDesc {
    float factor = 0.0f;                      ///< [0, 1], share of the diffuse light
    Rgb color{1.0f};                          ///< [0, 1]
    std::optional<TextureRef> texture;        ///< linear; A, times factor
    std::optional<TextureRef> color_texture;  ///< sRGB
};

/// glTF 2.0 metallic-roughness material with KHR_materials_{anisotropy, clearcoat,
/// diffuse_transmission, dispersion, emissive_strength, iridescence, ior, sheen, specular,
/// transmission, volume, unlit}; names, defaults and ranges are those of the specification
/// [glTF 2.0, sec. 3.9; KHR extensions of these names].
struct MaterialDesc {
    std::string name{};
    Vec4 base_color{1.0f};  ///< [0, 1]
    AlphaMode alpha_mode = AlphaMode::opaque;
    float alpha_cutoff = 0.5f;  ///< >= 0
    /// Shines with its base colour as radiance [nit] and scatters nothing: a light like any other.
    /// Nothing but base colour, alpha and `double_sided` counts.
    bool unlit = false;
    float metallic = 1.0f;      ///< [0, 1]
    float roughness = 1.0f;     ///< [0, 1], perceptual; GGX alpha is its square; 0: a mirror
    Rgb emission{0.0f};         ///< radiance [nit], >= 0
    float normal_scale = 1.0f;  ///< times x and y of normal_texture
    bool double_sided = false;  ///< emits from both sides; scattering is two-sided in any case

    float ior = 1.5f;           ///< >= 1
    float specular = 1.0f;      ///< [0, 1]; 0 takes the dielectric reflection away
    Rgb specular_color{1.0f};   ///< >= 0, times the reflectance at normal incidence
    float transmission = 0.0f;  ///< [0, 1]
    float thickness = 0.0f;     ///< > 0: the mesh bounds a solid body; 0: a thin sheet
    float attenuation_distance = std::numeric_limits<float>::infinity();  ///< [m], > 0
    Rgb attenuation_color{1.0f};  ///< [0, 1], what is left of white after that distance
    float dispersion = 0.0f;      ///< >= 0, 20 / Abbe number of a solid transmitter

    ClearcoatDesc clearcoat{};
    SheenDesc sheen{};
    AnisotropyDesc anisotropy{};
    IridescenceDesc iridescence{};
    DiffuseTransmissionDesc diffuse_transmission{};

    std::optional<TextureRef> base_color_texture;          ///< sRGB, times base_color
    std::optional<TextureRef> metallic_roughness_texture;  ///< linear; G roughness, B metallic
    std::optional<TextureRef> normal_texture;              ///< linear, tangent space
    std::optional<TextureRef> emission_texture;            ///< sRGB, times emission
    std::optional<TextureRef> specular_texture;            ///< linear; A
    std::optional<TextureRef> specular_color_texture;      ///< sRGB
    std::optional<TextureRef> transmission_texture;        ///< linear; R
    std::optional<TextureRef> glossiness_texture;          ///< linear; A, times 1 - roughness

    /// All that there are, those of the layers included. They point into this object.
    [[nodiscard]] std::array<const std::optional<TextureRef>*, 18> textures() const
    {
        return {&base_color_texture,
                &metallic_roughness_texture,
                &normal_texture,
                &emission_texture,
                &specular_texture,
                &specular_color_texture,
                &transmission_texture,
                &glossiness_texture,
                &clearcoat.texture,
                &clearcoat.roughness_texture,
                &clearcoat.normal_texture,
                &sheen.color_texture,
                &sheen.roughness_texture,
                &anisotropy.texture,
                &iridescence.texture,
                &iridescence.thickness_texture,
                &diffuse_transmission.texture,
                &diffuse_transmission.color_texture};
    }
};

/// A mesh placed in the world [m]. Meshes are shared: many instances cost one BVH.
struct InstanceDesc {
    std::string name{};
    MeshId mesh{};
    MaterialId material{};
    Mat4 world_from_object{1.0f};  ///< affine, invertible; a negative determinant is fine
    /// Invertible on the way, too (`can_move`). As many steps as its mesh has, if both have any.
    std::vector<Mat4> motion{};
};

/// Shines alike in all directions; intensity over distance squared [KHR_lights_punctual].
struct PointLightDesc {
    std::string name{};
    Vec3 position{0.0f};
    Rgb intensity{1.0f};  ///< [cd]
    /// [m] 0: a point. Else a ball of radiance intensity / (pi radius^2), seen like any surface; it
    /// hides what is behind it and reflects nothing.
    float radius = 0.0f;
    std::vector<Vec3> motion{};  ///< of the position
};

/// A point light in a cone, smooth from the inner to the outer angle [KHR_lights_punctual].
struct SpotLightDesc {
    std::string name{};
    Vec3 position{0.0f};
    Vec3 direction{0.0f, 0.0f, -1.0f};    ///< the axis; of any length but 0
    Rgb intensity{1.0f};                  ///< [cd] within the inner cone
    float inner_cone_angle = 0.0f;        ///< [rad] from the axis
    float outer_cone_angle = 0.7853982f;  ///< [rad] from the axis, in (inner, pi/2]
    /// [m] As for point lights; the falloff is that of the direction in which light leaves the
    /// ball.
    float radius = 0.0f;
    std::vector<Vec3> motion{};  ///< of the position
    std::vector<Vec3> turn{};    ///< of the direction, by less than 90 degrees a step
};

/// The intensities of a luminaire by direction, on a grid of two angles: the polar angle from -z,
/// and the azimuth around that axis, from +x towards +y. Between the angles of the grid intensities
/// are bilinear in both; beyond its first and last ones it is dark.
struct LightProfile {
    std::vector<float> polar_angles;  ///< [rad] two or more, ascending, in [0, pi]
    std::vector<float> azimuths;      ///< [rad] ascending over at most a turn; one: round
    std::vector<float> intensities;   ///< [cd] those of all polar angles for each azimuth, >= 0
};

/// A point light that shines as a measured luminaire does [EXT_lights_ies].
struct ProfileLightDesc {
    std::string name{};
    Vec3 position{0.0f};
    Mat3 world_from_light{1.0f};  ///< orthonormal; may mirror
    Rgb scale{1.0f};              ///< >= 0, times the intensities of the profile
    ProfileId profile{};
    std::vector<Vec3> motion{};  ///< as of point lights; it does not turn
};

/// Light from infinity out of one direction, like the sun's [KHR_lights_punctual].
struct DirectionalLightDesc {
    std::string name{};
    Vec3 direction{0.0f, 0.0f, -1.0f};  ///< the way the light travels; of any length but 0
    Rgb illuminance{1.0f};              ///< [lx] on a surface that faces the light
    std::vector<Vec3> turn{};           ///< of the direction, by less than 90 degrees a step
};

/// Light from infinity. `radiance` is equirectangular [nit]: its top row is +y, its centre column
/// is seen along -z and columns to the right turn towards +x. A 1 x 1 picture is constant.
struct EnvironmentLightDesc {
    Image radiance;
    Mat3 world_from_environment{1.0f};  ///< rotation
};

/// A light that is no surface.
using LightDesc = std::variant<PointLightDesc, SpotLightDesc, DirectionalLightDesc,
                               EnvironmentLightDesc, ProfileLightDesc>;

/// Everything that light meets, as plain data: what a loader fills in and what `Scene` is built
/// from. Emissive triangles are lights by their material.
struct SceneDesc {
    std::vector<TexelImage> images;
    std::vector<MaterialDesc> materials;
    std::vector<MeshDesc> meshes;
    std::vector<InstanceDesc> instances;
    std::vector<LightProfile> profiles;
    std::vector<LightDesc> lights;  ///< at most one environment
    TextureFilter texture_filter = TextureFilter::bilinear;
};

/// How a camera maps directions or points to the film.
enum class Projection : std::uint8_t { perspective, orthographic };

/// A camera with the glTF axes: it looks down -z, +y is up.
struct CameraDesc {
    std::string name{};
    Mat4 world_from_camera{1.0f};  ///< its scale is ignored
    Projection projection = Projection::perspective;
    float vertical_fov = 0.7853982f;  ///< perspective: [rad], in (0, pi)
    float vertical_extent = 2.0f;     ///< orthographic: height of the view [m], > 0
    float lens_radius = 0.0f;         ///< perspective: of a thin lens [m], >= 0; 0 is a pinhole
    float focus_distance = 1.0f;      ///< of the plane that a thin lens shows sharp [m], > 0
    /// Width over height that the scene's author had in mind, if any. The film's own wins.
    std::optional<float> aspect_ratio{};
    std::vector<Mat4> motion{};  ///< as of instances
};

}  // namespace bdpt
