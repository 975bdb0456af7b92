#pragma once

/// @file
/// Describes a scene as plain data.
///
/// @code{.cpp}
/// bdpt::MeshDesc mesh;
/// mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
/// mesh.triangles = {{0, 1, 2}};
/// bdpt::SceneDesc desc;
/// desc.meshes = {mesh};
/// desc.materials.resize(1);
/// desc.instances.push_back({.mesh = bdpt::MeshId{0}, .material = bdpt::MaterialId{0}});
/// const bdpt::Scene scene(std::move(desc));
/// @endcode

#include <bdpt/fields.h>
#include <bdpt/image.h>
#include <bdpt/light_desc.h>
#include <bdpt/material_desc.h>
#include <bdpt/medium_desc.h>
#include <bdpt/scene_ids.h>
#include <bdpt/types.h>
#include <bdpt/volume_desc.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace bdpt {

// Things that move while the shutter is open have a `motion` or `turn`: the values at equally
// spaced later times, the last one when the shutter closes; the first value is that of the opening.
// Values are interpolated linearly (bdpt/motion.h). Empty: no motion.

/// The vertices of a mesh at a later time: as many of each attribute as the mesh has.
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
    std::vector<MeshPose> motion{};  ///< poses of a deforming mesh
};

/// A mesh placed in the world [m]. Meshes are shared: many instances use one BVH.
struct InstanceDesc {
    std::string name{};
    MeshId mesh{};
    MaterialId material{};
    Mat4 world_from_object{1.0f};  ///< affine, invertible; a negative determinant is fine
    /// Later transforms, also invertible in between (`can_move`). As many steps as its mesh has, if
    /// both have any.
    std::vector<Mat4> motion{};
};

/// Lookup of textures that have more detail than the image shows.
enum class TextureFilter : std::uint8_t {
    /// Bilinear interpolation of the texels of the full image: many samples per pixel average out
    /// the detail.
    bilinear,
    /// Interpolation in a smaller copy where texels are narrower than half a pixel seen directly
    /// from the camera: the same for all paths through the point. Emission, alpha, normals and
    /// directions use the full image.
    mip_mapped,
};

/// What is between the faces of two bodies that refract, where these touch.
enum class ContactKind : std::uint8_t {
    /// `bonded` where their indices of refraction differ (a liquid in its glass, cemented lenses),
    /// else `air` (panes, bricks).
    automatic,
    air,  ///< a thin film of air: two boundaries
    /// Nothing: one boundary, with the surface of the body that comes first. Where faces touch in
    /// part, move, shine or have alpha, there is air.
    bonded,
};

/// The whole scene as plain data: the output of loaders and the input of `Scene`. Emissive
/// triangles are lights by their material.
struct SceneDesc {
    std::vector<TexelImage> images;
    std::vector<MaterialDesc> materials;
    std::vector<MeshDesc> meshes;
    std::vector<InstanceDesc> instances;
    std::vector<LightProfile> profiles;
    std::vector<LightDesc> lights;  ///< at most one environment
    TextureFilter texture_filter = TextureFilter::bilinear;
    ContactKind contacts = ContactKind::automatic;
    /// Medium outside of all bodies; it fills the bounding sphere of the scene.
    std::optional<MediumDesc> fog{};
    std::vector<VolumeDesc> volumes{};
    /// Place of the world's origin in the coordinates of the file or the application [m]: loaders
    /// set it where a scene lies far from the origin. It moves nothing: `Aov::position` and other
    /// outputs add it to places in the world.
    DVec3 origin{0.0};
};

/// Mapping of directions or points to the film.
enum class Projection : std::uint8_t { perspective, orthographic };

/// A camera with the glTF axes: it looks down -z, +y is up.
struct CameraDesc {
    std::string name{};
    /// Scale is ignored. As all of a scene, cameras are in the world, whose origin may lie
    /// elsewhere than the file's: subtract `SceneDesc::origin` from places in the file.
    Mat4 world_from_camera{1.0f};
    Projection projection = Projection::perspective;
    float vertical_fov = 0.7853982f;  ///< perspective: [rad], in (0, pi)
    float vertical_extent = 2.0f;     ///< orthographic: height of the view [m], > 0
    /// Lens shift: place of the middle of the film relative to the camera's axis, in widths and
    /// heights of the film, in [-100, 100]. The view moves to the right with x and upwards with y.
    /// The axis (principal point) is at cx = width * (0.5 - shift.x), cy = height * (0.5 + shift.y)
    /// [pixels, from the top left].
    Vec2 shift{0.0f};
    /// Width over height of a pixel in the plane of the film, in [0.001, 1000]. In pixels, the
    /// focal lengths of a perspective camera are fy = height / (2 tan(vertical_fov / 2)) and
    /// fx = fy / pixel_aspect.
    float pixel_aspect = 1.0f;
    /// Perspective: radius of a thin lens [m], >= 0; 0 is a pinhole.
    float lens_radius = 0.0f;
    float focus_distance = 1.0f;  ///< distance of the plane in focus of a thin lens [m], > 0
    /// Aspect ratio, width over height, intended by the scene's author, if any. The film's aspect
    /// ratio takes precedence.
    std::optional<float> aspect_ratio{};
    std::vector<Mat4> motion{};  ///< as in `InstanceDesc`
};

// Lists of fields (bdpt/fields.h).
/// Fields of `MeshPose`, with names and limits.
template <>
inline constexpr auto fields<MeshPose> = all_fields(Field{"positions", &MeshPose::positions},
                                                    Field{"normals", &MeshPose::normals},
                                                    Field{"tangents", &MeshPose::tangents});
/// Fields of `MeshDesc`, with names and limits.
template <>
inline constexpr auto fields<MeshDesc> =
    all_fields(Field{"name", &MeshDesc::name}, Field{"positions", &MeshDesc::positions},
               Field{"normals", &MeshDesc::normals}, Field{"tangents", &MeshDesc::tangents},
               Field{"texture coordinates", &MeshDesc::uvs}, Field{"colours", &MeshDesc::colors},
               Field{"triangles", &MeshDesc::triangles}, Field{"motion", &MeshDesc::motion});
/// Fields of `InstanceDesc`, with names and limits.
template <>
inline constexpr auto fields<InstanceDesc> = all_fields(
    Field{"name", &InstanceDesc::name}, Field{"mesh", &InstanceDesc::mesh},
    Field{"material", &InstanceDesc::material},
    Field{"transform", &InstanceDesc::world_from_object}, Field{"motion", &InstanceDesc::motion});
/// Fields of `SceneDesc`, with names and limits.
template <>
inline constexpr auto fields<SceneDesc> =
    all_fields(Field{"images", &SceneDesc::images}, Field{"materials", &SceneDesc::materials},
               Field{"meshes", &SceneDesc::meshes}, Field{"instances", &SceneDesc::instances},
               Field{"profiles", &SceneDesc::profiles}, Field{"lights", &SceneDesc::lights},
               Field{"texture filter", &SceneDesc::texture_filter},
               Field{"contacts", &SceneDesc::contacts}, Field{"fog", &SceneDesc::fog},
               Field{"volumes", &SceneDesc::volumes}, Field{"origin", &SceneDesc::origin});
/// Fields of `CameraDesc`, with names and limits.
template <>
inline constexpr auto fields<CameraDesc> = all_fields(
    Field{"name", &CameraDesc::name}, Field{"transform", &CameraDesc::world_from_camera},
    Field{"projection", &CameraDesc::projection},
    Field{"vertical field of view", &CameraDesc::vertical_fov},
    Field{"vertical extent", &CameraDesc::vertical_extent},
    Number{"shift", &CameraDesc::shift, {.low = -100.0f, .high = 100.0f}},
    Number{"pixel aspect", &CameraDesc::pixel_aspect, {.low = 0.001f, .high = 1000.0f}},
    Field{"lens radius", &CameraDesc::lens_radius},
    Field{"focus distance", &CameraDesc::focus_distance},
    Field{"aspect ratio", &CameraDesc::aspect_ratio}, Field{"motion", &CameraDesc::motion});

}  // namespace bdpt
