#include <bdpt/default_lights.h>
#include <bdpt/error.h>
#include <bdpt/framing.h>
#include <bdpt/light_desc.h>
#include <bdpt/scene_desc.h>
#include <fmt/core.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include "arrays.h"
#include "attributes.h"
#include "machine/machine_limits.h"
#include "options/groups/view_arguments.h"
#include "python_scene.h"

namespace bdpt::python {
namespace {

namespace nb = nanobind;

/// A mesh with its material and placement.
struct ArrayMesh {
    MeshDesc desc;
    std::shared_ptr<ArrayMaterial> material;
    std::vector<Mat4> transforms;
};

/// Converts (n, 4, 4) matrices of NumPy, row-major.
std::vector<Mat4> to_matrices(const std::optional<FloatsLike<nb::shape<-1, 4, 4>>>& matrix_rows)
{
    if (!matrix_rows) {
        return {Mat4(1.0f)};
    }
    std::vector<Mat4> matrices = to_vectors<Mat4>(matrix_rows->array);
    for (Mat4& matrix : matrices) {
        matrix = glm::transpose(matrix);
    }
    return matrices;
}

using IndexInput = nb::ndarray<nb::ro, nb::c_contig, nb::device::cpu, nb::shape<-1, 3>>;

template <typename Number>
std::vector<UVec3> to_triangles(const IndexInput& array)
{
    const auto* indices = static_cast<const Number*>(array.data());
    std::vector<UVec3> triangles(array.shape(0));
    for (std::size_t i = 0; i < 3 * triangles.size(); ++i) {
        if (!std::in_range<std::uint32_t>(indices[i])) {
            throw Error(ErrorCode::invalid_input,
                        fmt::format("triangles: triangle {} has index {}", i / 3, indices[i]));
        }
        triangles[i / 3][static_cast<int>(i % 3)] = static_cast<std::uint32_t>(indices[i]);
    }
    return triangles;
}

/// Converts integers of the first of these types that the array has.
template <typename Number, typename... Others>
std::vector<UVec3> to_triangles_of(const IndexInput& array)
{
    if (array.dtype() == nb::dtype<Number>()) {
        return to_triangles<Number>(array);
    }
    if constexpr (sizeof...(Others) > 0) {
        return to_triangles_of<Others...>(array);
    }
    throw Error(ErrorCode::usage, "triangles: expected integers");
}

/// Converts integers of any size. NumPy would wrap those that are out of range, and truncate
/// fractions.
std::vector<UVec3> to_triangles(const IndexInput& array)
{
    return to_triangles_of<std::uint32_t, std::int64_t, std::uint64_t, std::int32_t, std::int16_t,
                           std::int8_t, std::uint16_t, std::uint8_t>(array);
}

ArrayMesh make_mesh(const FloatsLike<nb::shape<-1, 3>>& positions,
                    const ArrayLike<IndexInput>& triangles,
                    const std::optional<FloatsLike<nb::shape<-1, 3>>>& normals,
                    const std::optional<FloatsLike<nb::shape<-1, 2>>>& uvs,
                    const std::shared_ptr<ArrayMaterial>& material,
                    const std::optional<FloatsLike<nb::shape<-1, 4, 4>>>& transforms,
                    const std::string& name)
{
    ArrayMesh mesh;
    mesh.desc.name = name;
    mesh.desc.positions = to_vectors<Vec3>(positions.array);
    mesh.desc.triangles = to_triangles(triangles.array);
    mesh.desc.normals = normals ? to_vectors<Vec3>(normals->array) : std::vector<Vec3>();
    mesh.desc.uvs[0] = uvs ? to_vectors<Vec2>(uvs->array) : std::vector<Vec2>();
    mesh.material = material ? material : std::make_shared<ArrayMaterial>();
    mesh.transforms = to_matrices(transforms);
    return mesh;
}

CameraDesc make_camera(const Three& from, const Three& look_at, float fov, float lens_radius,
                       const std::optional<float>& focus_distance)
{
    CameraDesc camera = job::apply(
        {.from = to_vec(from),
         .look_at = to_vec(look_at),
         .vertical_fov = static_cast<float>(static_cast<double>(fov) * std::numbers::pi / 180.0)},
        CameraDesc{}, std::nullopt);
    camera.lens_radius = lens_radius;
    camera.focus_distance = focus_distance.value_or(glm::length(to_vec(look_at) - to_vec(from)));
    return camera;
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
    scene.lights = to_lights(lights);
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
    std::string environment = "scene";
    std::vector<job::Note> notes;
    if (lights.empty()) {  // as load() does for files
        const FramedView framed = metered_view(scene);
        const DefaultLights missing = missing_lights(scene, framed);
        if (missing != DefaultLights::none) {
            scene = scene.with_lights(default_lights(missing, framed));
            environment = job::environment_name(missing);
            notes.push_back(
                missing == DefaultLights::sky_and_lamp
                    ? job::Note{"default_lamp", "a closed room without light: lit by a lamp"}
                    : job::Note{"default_sky", fmt::format("no light: lit by {}",
                                                           job::environment_text(missing))});
        }
    }
    const float aspect = static_cast<float>(size.first) / static_cast<float>(size.second);
    CameraDesc view = camera ? *camera : frame_scene(scene, aspect).camera;
    std::vector<std::string> warnings = scene.warnings();
    const std::size_t count = scene.counts().lights;
    new (self) PythonScene{.stage = {.scene = std::move(scene),
                                     .camera = view,
                                     .environment_name = environment,
                                     .size = {size.first, size.second},
                                     .warnings = std::move(warnings),
                                     .notes = std::move(notes),
                                     .lights = count,
                                     .cameras = {view},
                                     .memory = io::MemoryBudget(job::memory_limit(std::nullopt))},
                           .file = {},
                           .words = {}};
}

void bind_mesh_and_camera(nb::module_& module)
{
    nb::class_<ArrayMesh>(module, "Mesh", "Triangles with one material [m].")
        .def(nb::new_(&make_mesh), nb::arg("positions"), nb::arg("triangles"),
             nb::arg("normals") = nb::none(), nb::arg("uvs") = nb::none(),
             nb::arg("material").none() = nb::none(), nb::arg("transforms") = nb::none(),
             nb::arg("name") = "",
             "positions, normals: float32 (n, 3); triangles: integers (m, 3), counter-clockwise "
             "from the front; uvs: float32 (n, 2), v points down; transforms: float32 (k, 4, 4), "
             "one per instance.");
    nb::class_<CameraDesc>(module, "Camera", "A camera; +y is up.")
        .def(
            nb::new_(&make_camera), nb::arg("from_"), nb::arg("look_at"), nb::arg("fov") = 45.0f,
            nb::arg("lens_radius") = 0.0f, nb::arg("focus_distance") = nb::none(),
            "Position and target [m], vertical field of view [degrees], radius of a thin lens [m], "
            "focus distance [m] (default: that of the target).");
}

}  // namespace

void bind_parts_of_scenes(nb::module_& module)
{
    bind_material(module);
    bind_lights(module);
    bind_mesh_and_camera(module);
    nb::object scene = module.attr("Scene");
    nb::cast<nb::class_<PythonScene>>(scene).def(
        "__init__", &make_scene, nb::arg("meshes"), nb::arg("lights") = std::vector<ArrayLight>(),
        nb::arg("camera") = nb::none(), nb::arg("size") = std::pair(1280, 720),
        "Scene of meshes, lights and a camera; without a camera, the whole scene is framed, and "
        "without light it gets a key and a rim light (a room a soft sky, a closed one a lamp). "
        "Arrays are copied.");
}

void bind_lights(nb::module_& module)
{
    nb::class_<PointLightDesc> point(module, "PointLight", "A point light: isotropic.");
    point.def("__init__", &construct<PointLightDesc>, nb::arg("attributes"));
    point.def_rw("name", &PointLightDesc::name, "Name in id layers.");
    def_vec(point, "position", &PointLightDesc::position, "[m]");
    def_vec(point, "intensity", &PointLightDesc::intensity, "[cd]");
    point.def_rw("radius", &PointLightDesc::radius, "[m] 0: a point; else a sphere that is seen.");
    nb::class_<SpotLightDesc> spot(module, "SpotLight", "A point light in a cone.");
    spot.def("__init__", &construct<SpotLightDesc>, nb::arg("attributes"));
    spot.def_rw("name", &SpotLightDesc::name, "Name in id layers.");
    def_vec(spot, "position", &SpotLightDesc::position, "[m]");
    def_vec(spot, "direction", &SpotLightDesc::direction, "The axis.");
    def_vec(spot, "intensity", &SpotLightDesc::intensity, "[cd] within the inner cone");
    spot.def_rw("inner_cone_angle", &SpotLightDesc::inner_cone_angle, "[rad] from the axis");
    spot.def_rw("outer_cone_angle", &SpotLightDesc::outer_cone_angle, "[rad] from the axis");
    spot.def_rw("radius", &SpotLightDesc::radius, "[m] 0: a point; else a sphere that is seen.");
    nb::class_<DirectionalLightDesc> sun(module, "DirectionalLight", "A directional light.");
    sun.def("__init__", &construct<DirectionalLightDesc>, nb::arg("attributes"));
    def_vec(sun, "direction", &DirectionalLightDesc::direction,
            "Direction in which the light "
            "travels.");
    def_vec(sun, "illuminance", &DirectionalLightDesc::illuminance,
            "[lx] on a surface facing the light");
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

}  // namespace bdpt::python
