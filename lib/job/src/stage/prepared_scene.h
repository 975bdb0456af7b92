#pragma once

#include <bdpt/io/gltf.h>
#include <bdpt/light_desc.h>
#include <bdpt/scene.h>
#include <bdpt/scene_desc.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "messages/console.h"
#include "options/groups/scene_arguments.h"
#include "options/render_arguments.h"
#include "options/value_types.h"

namespace bdpt::job {

/// A scene with light and a camera, ready to render.
struct PreparedScene {
    Scene scene;
    CameraDesc camera;             ///< with its name or index, or "auto"
    std::string environment_name;  ///< for people: its file, "scene", "default", "studio" or "none"
    Size size;
    std::vector<std::string> warnings;  ///< one line each
    std::vector<Note> notes{};          ///< additions to a file that lacks something
    double load_seconds = 0.0;          ///< reading files
    double build_seconds = 0.0;         ///< building the scene
    std::string xmp{};                  ///< the file's metadata about itself
    /// Lights of the file and of --env, without those added to a dark scene.
    std::size_t lights = 0;
    bool is_framed = false;                      ///< the camera is not one of the file
    std::vector<CameraDesc> cameras{};           ///< those of the scene
    std::vector<std::filesystem::path> files{};  ///< that the scene names
    io::MemoryBudget memory;                     ///< the scene's memory is already charged
};

/// Returns "36 triangles (2 emissive), 1 light".
[[nodiscard]] std::string size_text(const PreparedScene& stage);

/// Tests whether an environment lights the scene.
[[nodiscard]] bool has_environment(const PreparedScene& stage);

/// Returns `light` rotated and scaled.
[[nodiscard]] EnvironmentLightDesc changed(EnvironmentLightDesc light,
                                           const EnvironmentChange& change);

/// A camera and the size of its image.
struct Viewpoint {
    CameraDesc camera;  ///< with its name or index
    Size size;
    bool is_framed = false;  ///< the camera is not one of the file
};

/// Loads the file, and fills in defaults by the rules that `bdpt render --help` states. Memory is
/// charged to `arguments.scene.memory`, or to `arguments.memory` if there is none. Throws `Error`.
[[nodiscard]] PreparedScene prepare_scene(const RenderArguments& arguments);

/// Returns camera `index` of the scene, with the view and the lens of `arguments`. Throws `Error`.
[[nodiscard]] Viewpoint viewpoint(const PreparedScene& stage, std::size_t index,
                                  const RenderArguments& arguments);

/// Returns the view of the camera that `arguments` choose; it may be framed for another size than
/// before. Throws `Error`.
[[nodiscard]] Viewpoint viewpoint(const PreparedScene& stage, const RenderArguments& arguments);

/// Returns the names of the cameras, or their indices if they have none.
[[nodiscard]] std::vector<std::string> camera_names(const PreparedScene& stage);

/// Returns the share of the image that surfaces fill, in [0, 1]. `aspect` is width over height.
/// Throws `Error` for a camera that is too far away to render.
[[nodiscard]] double filled_share(const Scene& scene, const CameraDesc& camera, float aspect);

}  // namespace bdpt::job
