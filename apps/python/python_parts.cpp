#include <bdpt/error.h>
#include <bdpt/framing.h>
#include <bdpt/scene_desc.h>
#include <fmt/core.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "arrays.h"
#include "options/values/view.h"
#include "python_scene.h"

namespace bdpt::python {
namespace {

using Three = std::array<float, 3>;
using Four = std::array<float, 4>;
using ArrayLight =
    std::variant<PointLightDesc, SpotLightDesc, DirectionalLightDesc, EnvironmentLightDesc>;

/// A material, and its textures by the slot that they are for.
struct ArrayMaterial {
    MaterialDesc desc;
    std::map<std::string, TexelImage> textures;
};

/// A mesh with its material and where it stands.
struct ArrayMesh {
    MeshDesc desc;
    std::shared_ptr<ArrayMaterial> material;
    std::vector<Mat4> transforms;
};

Vec3 to_vec(const Three& values)
{
    return {values[0], values[1], values[2]};
}

Vec4 to_vec(const Four& values)
{
    return {values[0], values[1], values[2], values[3]};
}

/// Keyword arguments set the attributes of that name.
template <typename T>
void construct(nb::pointer_and_handle<T> self, const nb::kwargs& values)
{
    new (self.p) T();
    nb::inst_mark_ready(self.h);
    for (const auto& [name, value] : values) {
        nb::setattr(self.h, name, value);
    }
}

template <typename T, typename Class>
void def_vec(Class& type, const char* name, T member, const char* text)
{
    using Owner = typename Class::Type;
    using Value = std::remove_reference_t<decltype(std::declval<Owner&>().*member)>;
    using Array = std::array<float, static_cast<std::size_t>(Value::length())>;
    type.def_prop_rw(
        name,
        [member](const Owner& owner) {
            Array array{};
            for (int i = 0; i < Value::length(); ++i) {
                array[static_cast<std::size_t>(i)] = (owner.*member)[i];
            }
            return array;
        },
        [member](Owner& owner, const Array& values) { owner.*member = to_vec(values); }, text);
}

template <typename T>
void def_number(nb::class_<ArrayMaterial>& type, const char* name, T MaterialDesc::*member,
                const char* text)
{
    type.def_prop_rw(
        name, [member](const ArrayMaterial& material) { return material.desc.*member; },
        [member](ArrayMaterial& material, T value) { material.desc.*member = value; }, text);
}

void def_color(nb::class_<ArrayMaterial>& type, const char* name, Rgb MaterialDesc::*member,
               const char* text)
{
    type.def_prop_rw(
        name,
        [member](const ArrayMaterial& material) {
            const Rgb& color = material.desc.*member;
            return Three{color.r, color.g, color.b};
        },
        [member](ArrayMaterial& material, const Three& value) {
            material.desc.*member = to_vec(value);
        },
        text);
}

TexelImage to_texels(const nb::ndarray<nb::ro, nb::c_contig, nb::device::cpu>& array)
{
    const auto type = array.dtype() == nb::dtype<std::uint8_t>()    ? TexelType::unorm8
                      : array.dtype() == nb::dtype<std::uint16_t>() ? TexelType::unorm16
                                                                    : TexelType::float32;
    if (type == TexelType::float32 && array.dtype() != nb::dtype<float>()) {
        throw Error(ErrorCode::usage, "a texture is an array of uint8, uint16 or float32");
    }
    constexpr std::size_t most_channels = 4;
    if (array.ndim() < 2 || array.ndim() > 3 ||
        (array.ndim() == 3 && array.shape(2) > most_channels)) {
        throw Error(ErrorCode::usage,
                    "a texture has the shape (height, width, channels), with 1 to 4 "
                    "channels, or (height, width)");
    }
    const auto* bytes = static_cast<const std::uint8_t*>(array.data());
    return {.width = static_cast<int>(array.shape(1)),
            .height = static_cast<int>(array.shape(0)),
            .bytes = std::vector<std::uint8_t>(bytes, bytes + array.nbytes()),
            .channels = array.ndim() == 3 ? static_cast<int>(array.shape(2)) : 1,
            .type = type};
}

using TextureSlot = std::optional<TextureRef> MaterialDesc::*;
constexpr std::pair<const char*, TextureSlot> texture_slots[]{
    {"base_color_texture", &MaterialDesc::base_color_texture},
    {"metallic_roughness_texture", &MaterialDesc::metallic_roughness_texture},
    {"normal_texture", &MaterialDesc::normal_texture},
    {"emission_texture", &MaterialDesc::emission_texture},
    {"transmission_texture", &MaterialDesc::transmission_texture},
};

void bind_material(nb::module_& module)
{
    nb::class_<ArrayMaterial> type(module, "Material",
                                   "A material as in glTF 2.0, with its names, units and defaults. "
                                   "Keyword arguments are attributes.");
    type.def("__init__", &construct<ArrayMaterial>, nb::arg("attributes"));
    type.def_prop_rw(
        "base_color",
        [](const ArrayMaterial& material) {
            const Vec4& color = material.desc.base_color;
            return Four{color.r, color.g, color.b, color.a};
        },
        [](ArrayMaterial& material, const std::vector<float>& color) {
            if (color.size() != 3 && color.size() != 4) {
                throw Error(ErrorCode::usage, "base_color: expected three or four numbers");
            }
            material.desc.base_color = {color[0], color[1], color[2],
                                        color.size() == 4 ? color[3] : 1.0f};
        },
        "Linear RGB or RGBA, [0, 1].");
    def_number(type, "metallic", &MaterialDesc::metallic, "[0, 1]; default 1.");
    def_number(type, "roughness", &MaterialDesc::roughness, "[0, 1]; default 1.");
    def_color(type, "emission", &MaterialDesc::emission, "Radiance [nit].");
    def_number(type, "double_sided", &MaterialDesc::double_sided, "Emits from both sides.");
    def_number(type, "unlit", &MaterialDesc::unlit, "Shines with its base colour [nit].");
    def_number(type, "ior", &MaterialDesc::ior, "Index of refraction; default 1.5.");
    def_number(type, "specular", &MaterialDesc::specular, "[0, 1]; default 1.");
    def_number(type, "transmission", &MaterialDesc::transmission, "[0, 1].");
    def_number(type, "thickness", &MaterialDesc::thickness,
               "Above 0: the mesh bounds a solid body; 0: a thin sheet.");
    def_number(type, "attenuation_distance", &MaterialDesc::attenuation_distance, "[m]");
    def_color(type, "attenuation_color", &MaterialDesc::attenuation_color,
              "What is left of white after attenuation_distance.");
    def_number(type, "dispersion", &MaterialDesc::dispersion, "20 / Abbe number.");
    for (const auto& [name, slot] : texture_slots) {
        type.def_prop_rw(
            name, [](const ArrayMaterial&) { return nb::none(); },
            [name = std::string(name)](
                ArrayMaterial& material,
                const nb::ndarray<nb::ro, nb::c_contig, nb::device::cpu>& array) {
                material.textures[name] = to_texels(array);
            },
            "An array (height, width, channels) of uint8, uint16 or float32; write only.");
    }
}

/// (n, 4, 4) matrices as NumPy has them, by rows.
std::vector<Mat4> to_matrices(const std::optional<FloatInput<nb::shape<-1, 4, 4>>>& array)
{
    if (!array) {
        return {Mat4(1.0f)};
    }
    std::vector<Mat4> matrices = to_vectors<Mat4>(*array);
    for (Mat4& matrix : matrices) {
        matrix = glm::transpose(matrix);
    }
    return matrices;
}

ArrayMesh make_mesh(const FloatInput<nb::shape<-1, 3>>& positions,
                    const nb::ndarray<const std::uint32_t, nb::c_contig, nb::device::cpu,
                                      nb::shape<-1, 3>>& triangles,
                    const std::optional<FloatInput<nb::shape<-1, 3>>>& normals,
                    const std::optional<FloatInput<nb::shape<-1, 2>>>& uvs,
                    const std::shared_ptr<ArrayMaterial>& material,
                    const std::optional<FloatInput<nb::shape<-1, 4, 4>>>& transforms,
                    const std::string& name)
{
    ArrayMesh mesh;
    mesh.desc.name = name;
    mesh.desc.positions = to_vectors<Vec3>(positions);
    mesh.desc.triangles = to_vectors<UVec3>(triangles);
    mesh.desc.normals = normals ? to_vectors<Vec3>(*normals) : std::vector<Vec3>();
    mesh.desc.uvs[0] = uvs ? to_vectors<Vec2>(*uvs) : std::vector<Vec2>();
    mesh.material = material ? material : std::make_shared<ArrayMaterial>();
    mesh.transforms = to_matrices(transforms);
    return mesh;
}

void bind_lights(nb::module_& module)
{
    nb::class_<PointLightDesc> point(module, "PointLight", "Shines alike in all directions.");
    point.def("__init__", &construct<PointLightDesc>, nb::arg("attributes"));
    def_vec(point, "position", &PointLightDesc::position, "[m]");
    def_vec(point, "intensity", &PointLightDesc::intensity, "[cd]");
    point.def_rw("radius", &PointLightDesc::radius, "[m] 0: a point; else a sphere that is seen.");
    nb::class_<SpotLightDesc> spot(module, "SpotLight", "A point light in a cone.");
    spot.def("__init__", &construct<SpotLightDesc>, nb::arg("attributes"));
    def_vec(spot, "position", &SpotLightDesc::position, "[m]");
    def_vec(spot, "direction", &SpotLightDesc::direction, "The axis.");
    def_vec(spot, "intensity", &SpotLightDesc::intensity, "[cd] within the inner cone");
    spot.def_rw("inner_cone_angle", &SpotLightDesc::inner_cone_angle, "[rad] from the axis");
    spot.def_rw("outer_cone_angle", &SpotLightDesc::outer_cone_angle, "[rad] from the axis");
    spot.def_rw("radius", &SpotLightDesc::radius, "[m] 0: a point; else a sphere that is seen.");
    nb::class_<DirectionalLightDesc> sun(module, "DirectionalLight", "Light out of one direction.");
    sun.def("__init__", &construct<DirectionalLightDesc>, nb::arg("attributes"));
    def_vec(sun, "direction", &DirectionalLightDesc::direction, "The way the light travels.");
    def_vec(sun, "illuminance", &DirectionalLightDesc::illuminance,
            "[lx] on a surface that faces the light");
    nb::class_<EnvironmentLightDesc>(module, "EnvironmentLight", "Light from infinity.")
        .def(
            "__init__",
            [](EnvironmentLightDesc* self, const ImageInput& radiance) {
                new (self) EnvironmentLightDesc{.radiance = to_image(radiance)};
            },
            nb::arg("radiance"),
            "An equirectangular array of float32 (height, width, 3) [nit]: the top row is +y, the "
            "centre column is seen along -z. Of shape (1, 1, 3) it is constant.");
}

CameraDesc make_camera(const Three& from, const Three& look_at, float fov, float lens_radius,
                       const std::optional<float>& focus_distance)
{
    CameraDesc camera = app::apply(
        {.from = to_vec(from),
         .look_at = to_vec(look_at),
         .vertical_fov = static_cast<float>(static_cast<double>(fov) * std::numbers::pi / 180.0)},
        CameraDesc{}, std::nullopt);
    camera.lens_radius = lens_radius;
    camera.focus_distance = focus_distance.value_or(glm::length(to_vec(look_at) - to_vec(from)));
    return camera;
}

/// Puts the textures of a material into the scene.
MaterialDesc with_textures(const ArrayMaterial& material, SceneDesc& scene)
{
    MaterialDesc desc = material.desc;
    for (const auto& [name, slot] : texture_slots) {
        const auto found = material.textures.find(name);
        if (found != material.textures.end()) {
            desc.*slot =
                TextureRef{.image = ImageId{static_cast<std::uint32_t>(scene.images.size())}};
            scene.images.push_back(found->second);
        }
    }
    return desc;
}

SceneDesc describe(const std::vector<ArrayMesh>& meshes, const std::vector<ArrayLight>& lights)
{
    SceneDesc scene;
    std::map<const ArrayMaterial*, MaterialId> materials;
    for (const ArrayMesh& mesh : meshes) {
        const auto [known, is_new] = materials.try_emplace(
            mesh.material.get(), MaterialId{static_cast<std::uint32_t>(scene.materials.size())});
        if (is_new) {
            scene.materials.push_back(with_textures(*mesh.material, scene));
        }
        const MeshId id{static_cast<std::uint32_t>(scene.meshes.size())};
        scene.meshes.push_back(mesh.desc);
        for (const Mat4& transform : mesh.transforms) {
            scene.instances.push_back({.name = mesh.desc.name,
                                       .mesh = id,
                                       .material = known->second,
                                       .world_from_object = transform});
        }
    }
    for (const ArrayLight& light : lights) {
        std::visit([&scene](const auto& desc) { scene.lights.emplace_back(desc); }, light);
    }
    return scene;
}

void make_scene(PythonScene* self, const std::vector<ArrayMesh>& meshes,
                const std::vector<ArrayLight>& lights, const std::optional<CameraDesc>& camera,
                const std::pair<int, int>& size)
{
    if (size.first < 1 || size.second < 1) {
        throw Error(ErrorCode::usage, fmt::format("size: {} x {} pixels", size.first, size.second));
    }
    Scene scene(describe(meshes, lights));
    const float aspect = static_cast<float>(size.first) / static_cast<float>(size.second);
    CameraDesc view = camera ? *camera : frame_scene(scene, aspect).camera;
    std::vector<std::string> warnings = scene.warnings();
    const std::size_t count = scene.counts().lights;
    new (self) PythonScene{.stage = {.scene = std::move(scene),
                                     .camera = view,
                                     .environment_name = "scene",
                                     .size = {size.first, size.second},
                                     .warnings = std::move(warnings),
                                     .lights = count,
                                     .cameras = {view}},
                           .file = {},
                           .words = {}};
}

}  // namespace

void bind_parts_of_scenes(nb::module_& module)
{
    bind_material(module);
    bind_lights(module);
    nb::class_<ArrayMesh>(module, "Mesh", "Triangles with one material [m].")
        .def(
            "__init__",
            [](ArrayMesh* self, const FloatInput<nb::shape<-1, 3>>& positions,
               const nb::ndarray<const std::uint32_t, nb::c_contig, nb::device::cpu,
                                 nb::shape<-1, 3>>& triangles,
               const std::optional<FloatInput<nb::shape<-1, 3>>>& normals,
               const std::optional<FloatInput<nb::shape<-1, 2>>>& uvs,
               const std::shared_ptr<ArrayMaterial>& material,
               const std::optional<FloatInput<nb::shape<-1, 4, 4>>>& transforms,
               const std::string& name) {
                new (self) ArrayMesh(
                    make_mesh(positions, triangles, normals, uvs, material, transforms, name));
            },
            nb::arg("positions"), nb::arg("triangles"), nb::arg("normals") = nb::none(),
            nb::arg("uvs") = nb::none(), nb::arg("material").none() = nb::none(),
            nb::arg("transforms") = nb::none(), nb::arg("name") = "",
            "positions, normals: float32 (n, 3); triangles: uint32 (m, 3), counter-clockwise from "
            "the "
            "front; uvs: float32 (n, 2), v grows downwards; transforms: float32 (k, 4, 4), one for "
            "each place where it stands.");
    nb::class_<CameraDesc>(module, "Camera", "A camera; +y is up.")
        .def(
            "__init__",
            [](CameraDesc* self, const Three& from, const Three& look_at, float fov,
               float lens_radius, const std::optional<float>& focus_distance) {
                new (self) CameraDesc(make_camera(from, look_at, fov, lens_radius, focus_distance));
            },
            nb::arg("from_"), nb::arg("look_at"), nb::arg("fov") = 45.0f,
            nb::arg("lens_radius") = 0.0f, nb::arg("focus_distance") = nb::none(),
            "Position and target [m], vertical field of view [degrees], radius of a thin lens [m], "
            "distance of what is sharp [m] (default: that of the target).");
    nb::object scene = module.attr("Scene");
    nb::cast<nb::class_<PythonScene>>(scene).def(
        "__init__", &make_scene, nb::arg("meshes"), nb::arg("lights") = std::vector<ArrayLight>(),
        nb::arg("camera") = nb::none(), nb::arg("size") = std::pair(1280, 720),
        "Of meshes, lights and a camera; without one all of it is framed. Arrays are copied.");
}

}  // namespace bdpt::python
