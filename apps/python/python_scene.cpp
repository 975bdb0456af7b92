#include "python_scene.h"

#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <filesystem>
#include <utility>

#include "interpreter_lock.h"

namespace bdpt::python {
namespace {

namespace nb = nanobind;

PythonScene load(const std::filesystem::path& file, const nb::kwargs& options)
{
    const Words words = words_of(options, Call::load);
    app::RenderArguments arguments = understand_render(words);
    arguments.file = file;
    const Unlocked unlocked;
    return {.stage = prepare_scene(arguments), .file = file.string(), .words = words};
}

}  // namespace

void bind_scene(nb::module_& module)
{
    nb::class_<PythonScene>(module, "Scene",
                            "A scene that is ready to render, with its camera. Made by load(), or "
                            "from arrays.")
        .def_prop_ro(
            "size",
            [](const PythonScene& scene) {
                return std::pair(scene.stage.size.width, scene.stage.size.height);
            },
            "Width and height of its image [pixels].")
        .def_prop_ro(
            "cameras", [](const PythonScene& scene) { return camera_names(scene.stage); },
            "Names of the cameras of the file, or their indices.")
        .def_prop_ro(
            "warnings", [](const PythonScene& scene) { return scene.stage.warnings; },
            "What the command would warn of, one line each.")
        .def_prop_ro(
            "triangles",
            [](const PythonScene& scene) { return scene.stage.scene.counts().instanced_triangles; },
            "Triangles of all instances.")
        .def_prop_ro(
            "lights", [](const PythonScene& scene) { return scene.stage.scene.counts().lights; },
            "Lights, emitting triangles among them.")
        .def_prop_ro(
            "isa", [](const PythonScene& scene) { return isa_name(scene.stage.scene.isa()); },
            "Instruction set that its rays are traced with.")
        .def("__repr__", [](const PythonScene& scene) {
            return nb::str("<bdpt.Scene {}, {} triangles>")
                .format(scene.file.empty() ? "of arrays" : scene.file.c_str(),
                        scene.stage.scene.counts().instanced_triangles);
        });
    const std::string signature =
        declaration("def load(file: str | os.PathLike[str], *", Call::load, "Scene");
    const std::string text = documentation(
        "Loads a .gltf or .glb file. What it lacks (a camera, light) is filled in as bdpt render "
        "does.",
        Call::load);
    module.def("load", &load, nb::arg("file"), nb::arg("options"), nb::sig(signature.c_str()),
               text.c_str());
}

}  // namespace bdpt::python
