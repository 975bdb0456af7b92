#pragma once

#include <bdpt/io/part_file.h>
#include <bdpt/part/render_result.h>
#include <bdpt/render.h>
#include <nanobind/nanobind.h>

#include <filesystem>
#include <optional>
#include <vector>

#include "options/groups/image_arguments.h"
#include "options/render_arguments.h"
#include "python_scene.h"

namespace bdpt::python {

/// The result of a render so far.
struct Render {
    RenderResult part;
    io::PartNotes notes;
    std::optional<job::Backdrop> backdrop{};
    std::vector<std::filesystem::path> inputs{};  ///< files that must not be overwritten
};

/// Input of one call of render().
struct Task {
    job::RenderArguments arguments;
    job::PreparedScene stage;  ///< shows the view of this call; shares the geometry of the `Scene`
    io::ImageMetadata metadata{};
};

/// Prepares the task of render() with these options. The scene is unchanged: other threads may
/// render other views of it. Throws `Error`.
[[nodiscard]] Task prepare(const PythonScene& scene, const nanobind::kwargs& options);

/// Returns a render of `task` without samples.
[[nodiscard]] Render empty_render(const Task& task);

/// Returns a control that checks for Ctrl-C between passes, calls `progress`, unless that is None,
/// and ends at the limits of `goal`.
[[nodiscard]] RenderControl make_control(const nanobind::object& progress, const job::Goal& goal);

/// Head of the declaration of save(), for `declaration`.
inline constexpr const char* saving_head =
    "def save(self, file: str | os.PathLike[str] | typing.BinaryIO, *, "
    "format: typing.Literal[\"exr\", \"hdr\", \"png\", \"jpg\", \"webp\", \"part\"] | None = "
    "None";

/// Writes an image or a part, to a path or to an object with write(), for which `options` name the
/// format. Throws `Error`.
void save(const Render& render, const nanobind::object& file, const nanobind::kwargs& options);

/// Returns the image as a PNG file, for notebooks.
[[nodiscard]] nanobind::bytes to_png(const Render& render);

/// Binds `Renderer`.
void bind_renderer(nanobind::module_& module);

}  // namespace bdpt::python
