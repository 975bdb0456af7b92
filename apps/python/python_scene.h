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
    std::string file;  ///< empty: it was made of arrays
    Words words;
    std::optional<std::filesystem::path> origin{};  ///< the file of which load() makes it again
};

/// load() and `Scene`.
void bind_scene(nanobind::module_& module);

/// Materials of arrays.
void bind_material(nanobind::module_& module);

/// Lights of arrays.
void bind_lights(nanobind::module_& module);

/// These, meshes, cameras, and the `Scene` of them.
void bind_parts_of_scenes(nanobind::module_& module);

/// What makes other scenes of a `Scene`: its materials and lights.
void bind_edits(nanobind::module_& module);

/// render(), `Render` and what belongs to it.
void bind_render(nanobind::module_& module);

/// compare().
void bind_compare(nanobind::module_& module);

}  // namespace bdpt::python
