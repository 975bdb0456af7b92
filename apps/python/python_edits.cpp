#include <bdpt/error.h>
#include <fmt/core.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "attributes.h"
#include "interpreter_lock.h"
#include "python_scene.h"

namespace bdpt::python {

namespace nb = nanobind;

PythonScene with_scene(const PythonScene& original, Scene scene, std::string environment_name)
{
    const job::PreparedScene& stage = original.stage;
    const std::size_t lights = scene.counts().lights;
    return {.stage = {.scene = std::move(scene),
                      .camera = stage.camera,
                      .environment_name = std::move(environment_name),
                      .size = stage.size,
                      .warnings = stage.warnings,
                      .notes = stage.notes,
                      .facts = stage.facts,
                      .lights = lights,
                      .is_framed = stage.is_framed,
                      .cameras = stage.cameras,
                      .files = stage.files,
                      .memory = stage.memory},
            .file = original.file,
            .words = original.words};
}

namespace {

std::vector<std::string> material_names(const PythonScene& scene)
{
    std::vector<std::string> names;
    for (const MaterialDesc& material : scene.stage.scene.description().materials) {
        names.push_back(material.name);
    }
    return names;
}

/// Returns the index of the only material of that name. Throws `Error`: not_found, or invalid_input
/// if there are several.
std::size_t find_number(const PythonScene& scene, const std::string& name)
{
    const std::vector<MaterialDesc>& materials = scene.stage.scene.description().materials;
    const auto is_it = [&name](const MaterialDesc& material) { return material.name == name; };
    const auto found = std::find_if(materials.begin(), materials.end(), is_it);
    if (found == materials.end()) {
        fail_name("material", name, material_names(scene));
    }
    if (std::any_of(found + 1, materials.end(), is_it)) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("several materials \"{}\": use their numbers", name));
    }
    return static_cast<std::size_t>(found - materials.begin());
}

using NameOrNumber = std::variant<std::size_t, std::string>;

std::size_t find_number(const PythonScene& scene, const NameOrNumber& material)
{
    const std::size_t* const number = std::get_if<std::size_t>(&material);
    if (number == nullptr) {
        return find_number(scene, std::get<std::string>(material));
    }
    const std::size_t count = scene.stage.scene.description().materials.size();
    if (*number >= count) {
        throw job::UnknownName(fmt::format("no material {}: the scene has {}", *number, count));
    }
    return *number;
}

std::shared_ptr<ArrayMaterial> make_array_material(const PythonScene& scene,
                                                   const NameOrNumber& material)
{
    return std::make_shared<ArrayMaterial>(ArrayMaterial{
        .desc = scene.stage.scene.description().materials[find_number(scene, material)],
        .textures = {}});
}

PythonScene with_material(const PythonScene& scene, const NameOrNumber& which,
                          const std::shared_ptr<ArrayMaterial>& material)
{
    const std::size_t number = find_number(scene, which);
    const Scene& old = scene.stage.scene;
    const Unlocked unlocked;
    if (material->textures.empty()) {
        return with_scene(scene, old.with(static_cast<MaterialId>(number), material->desc),
                          scene.stage.environment_name);
    }
    SharedSceneDesc desc = old.description();
    SceneDesc images{.images = desc.images};
    std::vector<MaterialDesc> materials = desc.materials;
    materials[number] = with_textures(*material, images);
    desc.images = std::move(images.images);
    desc.materials = std::move(materials);
    return with_scene(scene, old.edited(std::move(desc)), scene.stage.environment_name);
}

PythonScene with_lights(const PythonScene& scene, const std::vector<ArrayLight>& lights)
{
    std::vector<LightDesc> descs = to_lights(lights);
    for (LightDesc& desc : descs) {
        std::visit(
            [&origin = scene.stage.scene.description().origin](auto& light) {
                if constexpr (requires { light.position; }) {
                    light.position = job::to_world(DVec3(light.position), origin);
                }
            },
            desc);
    }
    const bool has_environment = std::any_of(
        descs.begin(), descs.end(),
        [](const LightDesc& light) { return std::holds_alternative<EnvironmentLightDesc>(light); });
    const Unlocked unlocked;
    return with_scene(scene, scene.stage.scene.with_lights(descs),
                      has_environment ? "scene" : "none");
}

PythonScene with_environment(const PythonScene& scene,
                             const std::shared_ptr<Editable<EnvironmentLightDesc>>& environment)
{
    const Unlocked unlocked;
    return with_scene(scene,
                      scene.stage.scene.with_environment(
                          environment ? std::optional(environment->desc) : std::nullopt),
                      environment ? "scene" : "none");
}

}  // namespace

void bind_edits(nb::module_& module)
{
    nb::object scene = module.attr("Scene");
    nb::cast<nb::class_<PythonScene>>(scene)
        .def_prop_ro("materials", &material_names,
                     "Names of all materials, by number; '' where the file has none.")
        .def("material", &make_array_material, nb::arg("material"),
             "A copy of the material with this name or number. It keeps the textures of the scene "
             "where its own are None.")
        .def("with_material", &with_material, nb::arg("material"), nb::arg("changed"),
             "The scene with the material of this name or number replaced. Edits share unchanged "
             "data: they take milliseconds, and the image is bit-identical to that of a new scene.")
        .def("with_lights", &with_lights, nb::arg("lights"),
             "The scene with these lights instead of all that are not surfaces.")
        .def("with_environment", &with_environment, nb::arg("environment").none(),
             "The scene with another environment, or with none.");
}

}  // namespace bdpt::python
