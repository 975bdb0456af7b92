#include <bdpt/default_lights.h>
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

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "arrays.h"
#include "attributes.h"
#include "machine/machine_limits.h"
#include "python_parts.h"
#include "python_scene.h"

namespace bdpt::python {
namespace {

namespace nb = nanobind;

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
            throw ValueError(fmt::format("triangles: triangle {} has index {}", i / 3, indices[i]));
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
    throw CallError("triangles: expected integers");
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
                    const std::string& name,
                    const std::optional<FloatsLike<nb::shape<-1, 4>>>& colors)
{
    MeshDesc desc{.name = name};
    desc.colors = colors ? to_vectors<Vec4>(colors->array) : std::vector<Vec4>();
    desc.positions = to_vectors<Vec3>(positions.array);
    desc.triangles = to_triangles(triangles.array);
    desc.normals = normals ? to_vectors<Vec3>(normals->array) : std::vector<Vec3>();
    desc.uvs[0] = uvs ? to_vectors<Vec2>(uvs->array) : std::vector<Vec2>();
    const std::size_t count = desc.positions.size();
    for (const auto& [what, size] : {std::pair("normals", desc.normals.size()),
                                     {"uvs", desc.uvs[0].size()},
                                     {"colors", desc.colors.size()}}) {
        if (size != 0 && size != count) {
            throw ValueError(fmt::format("{} for {} positions: {}", what, count, size));
        }
    }
    for (std::size_t i = 0; i < desc.triangles.size(); ++i) {
        const UVec3& triangle = desc.triangles[i];
        const std::uint32_t largest = std::max({triangle.x, triangle.y, triangle.z});
        if (largest >= count) {
            throw ValueError(
                fmt::format("triangles: triangle {} has index {}, but there are {} "
                            "positions",
                            i, largest, count));
        }
    }
    return {.desc = std::make_shared<const MeshDesc>(std::move(desc)),
            .material = material ? material : std::make_shared<ArrayMaterial>(),
            .transforms = to_matrices(transforms)};
}

std::string to_text(const ArrayMesh& mesh)
{
    std::string text = fmt::format("Mesh(positions={}, triangles={}",
                                   array_text("float32", {mesh.desc->positions.size(), 3}),
                                   array_text("uint32", {mesh.desc->triangles.size(), 3}));
    if (!mesh.desc->normals.empty()) {
        text += ", normals=" + array_text("float32", {mesh.desc->normals.size(), 3});
    }
    if (!mesh.desc->uvs[0].empty()) {
        text += ", uvs=" + array_text("float32", {mesh.desc->uvs[0].size(), 2});
    }
    if (!mesh.desc->colors.empty()) {
        text += ", colors=" + array_text("float32", {mesh.desc->colors.size(), 4});
    }
    const std::string material = to_text(*mesh.material, "Material");
    text += material == "Material()" ? "" : ", material=" + material;
    if (mesh.transforms != std::vector{Mat4(1.0f)}) {
        text += ", transforms=" + array_text("float32", {mesh.transforms.size(), 4, 4});
    }
    return text + (mesh.desc->name.empty() ? "" : ", name=" + value_text(mesh.desc->name)) + ")";
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
        scene.meshes.push_back(*mesh.desc);
        for (const Mat4& transform : mesh.transforms) {
            scene.instances.push_back({.name = mesh.desc->name,
                                       .mesh = id,
                                       .material = known->second,
                                       .world_from_object = transform});
        }
    }
    scene.lights = to_lights(lights);
    return scene;
}

void make_scene(PythonScene* self, const std::vector<ArrayMesh>& meshes,
                const std::vector<ArrayLight>& lights, const std::optional<PythonCamera>& camera,
                const std::optional<std::pair<int, int>>& asked)
{
    const job::Size own = camera && camera->size ? *camera->size : job::Size{1280, 720};
    const std::pair<int, int> size = asked.value_or(std::pair(own.width, own.height));
    check_size(size);
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
    CameraDesc view = camera ? camera->in_world(DVec3(0.0)) : frame_scene(scene, aspect).camera;
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
    for (const ArrayMesh& mesh : meshes) {
        mesh.material->is_frozen = true;
    }
    for (const ArrayLight& light : lights) {
        std::visit([](const auto& part) { part->is_frozen = true; }, light);
    }
}

void bind_mesh(nb::module_& module)
{
    nb::class_<ArrayMesh>(module, "Mesh", "Triangles with one material [m].")
        .def(nb::new_(&make_mesh), nb::arg("positions"), nb::arg("triangles"),
             nb::arg("normals") = nb::none(), nb::arg("uvs") = nb::none(),
             nb::arg("material").none() = nb::none(), nb::arg("transforms") = nb::none(),
             nb::arg("name") = "", nb::arg("colors") = nb::none(),
             "positions, normals: float32 (n, 3); triangles: integers (m, 3), counter-clockwise "
             "from the front; uvs: float32 (n, 2), v points down; transforms: float32 (k, 4, 4), "
             "one per instance; colors: float32 (n, 4), linear RGBA that multiplies the base "
             "colour.")
        .def("__repr__", [](const ArrayMesh& mesh) { return to_text(mesh); });
}

}  // namespace

void bind_parts_of_scenes(nb::module_& module)
{
    bind_material(module);
    bind_lights(module);
    bind_mesh(module);
    bind_camera(module);
    nb::object scene = module.attr("Scene");
    nb::cast<nb::class_<PythonScene>>(scene).def(
        "__init__", &make_scene, nb::arg("meshes"), nb::arg("lights") = std::vector<ArrayLight>(),
        nb::arg("camera") = nb::none(), nb::arg("size") = nb::none(),
        "Scene of meshes, lights and a camera, whose image has this size [pixels] (default: that "
        "of the camera, or 1280 x 720); without a camera, the whole scene is framed, and "
        "without light it gets a key and a rim light (a room a soft sky, a closed one a lamp). "
        "Everything is copied; afterwards its materials and lights refuse changes.");
}

void bind_lights(nb::module_& module)
{
    bind_editable<PointLightDesc>(module, "PointLight", "A point light: isotropic.");
    bind_editable<SpotLightDesc>(module, "SpotLight", "A point light in a cone.");
    bind_editable<DirectionalLightDesc>(module, "DirectionalLight", "A directional light.");
    using EnvironmentLight = Editable<EnvironmentLightDesc>;
    nb::class_<EnvironmentLight>(module, "EnvironmentLight", "Light from infinity.")
        .def(
            "__init__",
            [](EnvironmentLight* self, const ImageInput& radiance) {
                new (self) EnvironmentLight{.desc = {.radiance = to_image(radiance)}};
            },
            nb::arg("radiance"),
            "An equirectangular array of float32 (height, width, 3) [nit]: the top row is +y, the "
            "centre column is seen along -z. Of shape (1, 1, 3) it is constant.")
        .def("__repr__", [](const EnvironmentLight& light) {
            const EnvironmentImage& image = light.desc.radiance;
            return fmt::format("EnvironmentLight(radiance={})",
                               array_text("float32", {static_cast<std::size_t>(image.height()),
                                                      static_cast<std::size_t>(image.width()), 3}));
        });
}

}  // namespace bdpt::python
