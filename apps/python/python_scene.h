#pragma once

#include <nanobind/nanobind.h>

#include <filesystem>
#include <optional>
#include <string>

#include "stage/prepared_scene.h"
#include "words.h"

namespace bdpt::python {

/// A scene that is ready to render, and the options that it was loaded with.
struct PythonScene {
    job::PreparedScene stage;
    std::string file;  ///< empty: made from arrays
    Words words;
    std::optional<std::filesystem::path> origin{};  ///< file from which load() can load it again
};

/// Binds load() and `Scene`.
void bind_scene(nanobind::module_& module);

/// Binds materials made from arrays.
void bind_material(nanobind::module_& module);

/// Binds lights made from arrays.
void bind_lights(nanobind::module_& module);

/// Binds cameras.
void bind_camera(nanobind::module_& module);

/// Binds these, meshes, and the `Scene` made from them.
void bind_parts_of_scenes(nanobind::module_& module);

/// Binds functions that derive other scenes from a `Scene`: by its materials and lights.
void bind_edits(nanobind::module_& module);

/// Binds what is in a `Scene`, as arrays: bounds, meshes, instances, rays.
void bind_scene_data(nanobind::module_& module);

/// Binds the views of a model in a data set.
void bind_dataset(nanobind::module_& module);

/// Returns `original` with another scene, but its camera, size and options.
[[nodiscard]] PythonScene with_scene(const PythonScene& original, Scene scene,
                                     std::string environment_name);

/// Binds render(), `Render` and related types.
void bind_render(nanobind::module_& module);

/// Binds run() and the types of its results.
void bind_job(nanobind::module_& module);

/// Reads all of `file`.
[[nodiscard]] nanobind::bytes read_bytes(const std::filesystem::path& file);

/// Creates `file`.
void write_bytes(const std::filesystem::path& file, const nanobind::bytes& contents);

/// Converts a path like os.fspath(). Raises TypeError for other objects.
[[nodiscard]] std::filesystem::path to_path(nanobind::handle value);

/// Returns contents in memory: bytes, objects with their interface, or the result of read(). None:
/// `value` is a path.
[[nodiscard]] std::optional<nanobind::bytes> read_contents(nanobind::handle value);

/// Tests whether `value` is a file object with write().
[[nodiscard]] bool is_writable_object(nanobind::handle value);

}  // namespace bdpt::python
