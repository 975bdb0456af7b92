#pragma once

#include <bdpt/io/part_file.h>
#include <bdpt/part/render_part.h>
#include <bdpt/render.h>
#include <nanobind/nanobind.h>

#include <filesystem>
#include <optional>
#include <vector>

#include "options/groups/display_arguments.h"
#include "options/render_arguments.h"
#include "python_scene.h"

namespace bdpt::python {

/// What a render brought so far.
struct Render {
    RenderPart part;
    io::PartNotes notes;
    std::optional<app::Backdrop> backdrop{};
    double seconds = 0.0;
    std::vector<std::filesystem::path> inputs{};  ///< files that nothing is saved to
};

/// What one call renders.
struct Task {
    app::RenderArguments arguments;
    CameraDesc camera;
    io::ImageMetadata metadata;
    std::optional<Scene> turned{};  ///< in place of the scene: a turntable whose light stands still

    [[nodiscard]] const Scene& scene(const PythonScene& given) const
    {
        return turned ? *turned : given.stage.scene;
    }
};

/// The task of render() with these options. The scene stays as it was: another size is that of one
/// call. Throws `Error`.
[[nodiscard]] Task prepare(PythonScene& scene, const nanobind::kwargs& options);

/// A render of `task` that has no samples yet.
[[nodiscard]] Render empty_render(const PythonScene& scene, const Task& task);

/// A control that looks for Ctrl-C between passes and calls `progress`, unless that is None.
[[nodiscard]] RenderControl control_of(const nanobind::object& progress);

/// How save() is declared: its head for `declaration`.
inline constexpr const char* saving_head =
    "def save(self, file: str | os.PathLike[str] | typing.BinaryIO, *, "
    "format: typing.Literal[\"exr\", \"hdr\", \"png\", \"jpg\", \"webp\", \"part\"] | None = "
    "None";

/// Writes an image or a part, to a path or to an object with write(), whose format `options` name
/// then. Throws `Error`.
void save(const Render& render, const nanobind::object& file, const nanobind::kwargs& options);

/// As a PNG file, for notebooks.
[[nodiscard]] nanobind::bytes to_png(const Render& render);

/// `Renderer`.
void bind_renderer(nanobind::module_& module);

}  // namespace bdpt::python
