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
    app::PreparedScene stage;
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

/// Binds these, meshes, cameras, and the `Scene` made from them.
void bind_parts_of_scenes(nanobind::module_& module);

/// Binds functions that derive other scenes from a `Scene`: by its materials and lights.
void bind_edits(nanobind::module_& module);

/// Binds render(), `Render` and related types.
void bind_render(nanobind::module_& module);

/// Binds run() and the types of its results.
void bind_job(nanobind::module_& module);

/// Binds compare().
void bind_compare(nanobind::module_& module);

}  // namespace bdpt::python
