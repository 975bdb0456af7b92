#include "python_scene.h"

#include <bdpt/error.h>
#include <fmt/core.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <fstream>
#include <iterator>
#include <new>
#include <tuple>
#include <utility>
#include <vector>

#include "interpreter_lock.h"
#include "options/output_files.h"
#include "python_errors.h"

namespace bdpt::python {

namespace nb = nanobind;
namespace fs = std::filesystem;

nb::bytes read_bytes(const fs::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    return nb::bytes(bytes.data(), bytes.size());
}

void write_bytes(const fs::path& file, const nb::bytes& contents)
{
    std::ofstream stream(file, std::ios::binary);
    stream.write(contents.c_str(), static_cast<std::streamsize>(contents.size()));
    stream.close();
    if (!stream) {
        throw Error(ErrorCode::output, fmt::format("{}: cannot write", file.string()));
    }
}

fs::path to_path(nb::handle value)
{
    const nb::object path = nb::steal(PyOS_FSPath(value.ptr()));
    if (!path.is_valid()) {
        throw nb::python_error();
    }
    return nb::cast<fs::path>(path);
}

std::optional<nb::bytes> read_contents(nb::handle value)
{
    if (nb::hasattr(value, "__fspath__") || PyUnicode_Check(value.ptr()) != 0) {
        return std::nullopt;
    }
    nb::object contents = nb::borrow(value);
    if (nb::hasattr(value, "read")) {
        contents = value.attr("read")();
        if (PyUnicode_Check(contents.ptr()) != 0) {
            throw nb::type_error("read() returns text: open the file in mode \"rb\"");
        }
    }
    if (PyObject_CheckBuffer(contents.ptr()) == 0) {
        return std::nullopt;
    }
    const nb::object bytes = nb::steal(PyBytes_FromObject(contents.ptr()));
    if (!bytes.is_valid()) {
        throw nb::python_error();
    }
    return nb::cast<nb::bytes>(bytes);
}

bool is_writable_object(nb::handle value)
{
    return nb::hasattr(value, "write") && !nb::hasattr(value, "__fspath__");
}

namespace {

PythonScene load_file(const fs::path& file, const Words& words)
{
    job::RenderArguments arguments = understand_render(words);
    arguments.file = file;
    std::error_code unknown;
    const Unlocked unlocked;
    return {.stage = prepare_scene(arguments),
            .file = file.string(),
            .words = words,
            .origin = fs::absolute(file, unknown)};
}

/// Replaces the path of a temporary file in `text` by this name.
std::string renamed(std::string text, const std::string& file, const std::string& name)
{
    for (std::size_t at = text.find(file); at != std::string::npos; at = text.find(file)) {
        text.replace(at, file.size(), name);
    }
    return text;
}

PythonScene load_bytes(const nb::bytes& contents, const Words& words)
{
    const std::string name = "bytes";
    const job::TemporaryFolder folder;
    const fs::path file = folder.file(name);
    write_bytes(file, contents);
    try {
        PythonScene scene = load_file(file, words);
        for (std::string& warning : scene.stage.warnings) {
            warning = renamed(warning, file.string(), name);
        }
        for (job::Note& note : scene.stage.notes) {
            note.text = renamed(note.text, file.string(), name);
        }
        scene.file = name;
        scene.origin.reset();
        return scene;
    } catch (const job::UnknownName& error) {
        throw job::UnknownName(renamed(error.what(), file.string(), name));
    } catch (const Error& error) {
        throw Error(error.code(), renamed(error.what(), file.string(), name));
    }
}

PythonScene load(const nb::object& source, const nb::kwargs& options)
{
    const Words words = to_words(options, Call::load);
    const std::optional<nb::bytes> contents = read_contents(source);
    std::vector<fs::path> files = given_paths(options, Call::load);
    if (contents) {
        return with_missing_file(files, [&] { return load_bytes(*contents, words); });
    }
    const fs::path file = to_path(source);
    files.push_back(file);
    return with_missing_file(files, [&] { return load_file(file, words); });
}

std::tuple<std::string, Words> get_state(const PythonScene& scene)
{
    if (!scene.origin) {
        throw nb::type_error(
            "only unedited scenes from load() can be pickled: pickle what this one is made of");
    }
    if (const auto word = find_unsafe(scene.words)) {
        throw nb::type_error(fmt::format("a scene with {} cannot be pickled: a pickle must not "
                                         "choose code to load or folders to read",
                                         *word)
                                 .c_str());
    }
    return {scene.origin->string(), scene.words};
}

/// Loads the scene of a pickle.
PythonScene load_state(const std::string& file, const Words& words)
{
    if (const auto word = find_unsafe(words)) {
        throw Error(ErrorCode::invalid_input,
                    fmt::format("a pickled scene must not have the option {}", *word));
    }
    return load_file(file, words);
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
            "Warnings of the command for this scene, one line each.")
        .def_prop_ro(
            "notes",
            [](const PythonScene& scene) {
                std::vector<std::string> texts;
                for (const job::Note& note : scene.stage.notes) {
                    texts.push_back(note.text);
                }
                return texts;
            },
            "Notes of the command for this scene, one line each: a light or a camera was added.")
        .def_prop_ro(
            "triangles",
            [](const PythonScene& scene) { return scene.stage.scene.counts().instanced_triangles; },
            "Number of triangles of all instances.")
        .def_prop_ro(
            "lights", [](const PythonScene& scene) { return scene.stage.scene.counts().lights; },
            "Number of lights, including emissive triangles.")
        .def_prop_ro(
            "isa", [](const PythonScene& scene) { return isa_name(scene.stage.scene.isa()); },
            "Instruction set of its ray tracing.")
        .def("__getstate__", &get_state)
        .def("__setstate__",
             [](PythonScene& scene, const std::tuple<std::string, Words>& state) {
                 new (&scene) PythonScene(load_state(std::get<0>(state), std::get<1>(state)));
             })
        .def("__repr__", [](const PythonScene& scene) {
            return nb::str("<bdpt.Scene {}, {} triangles>")
                .format(scene.file.empty() ? "of arrays" : scene.file.c_str(),
                        scene.stage.scene.counts().instanced_triangles);
        });
    const std::string signature = declaration(
        "def load(file: str | os.PathLike[str] | bytes | typing.BinaryIO, *", Call::load, "Scene");
    const std::string text = documentation(
        "Loads a .gltf or .glb file, its bytes, or an open file. A missing camera or light is "
        "added as bdpt render does.",
        Call::load);
    module.def("load", &load, nb::arg("file"), nb::arg("options"), nb::sig(signature.c_str()),
               text.c_str());
}

}  // namespace bdpt::python
