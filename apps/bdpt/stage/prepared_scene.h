#pragma once

#include <bdpt/io/gltf.h>
#include <bdpt/scene.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "options/arguments.h"
#include "options/render_arguments.h"

namespace bdpt::app {

/// A scene with light and a camera: ready to render.
struct PreparedScene {
    Scene scene;
    CameraDesc camera;             ///< named by its name or index, or "auto"
    std::string environment_name;  ///< for people: its file, "scene", "default", "studio" or "none"
    Size size;
    std::vector<std::string> warnings;  ///< one line each
    std::vector<std::string> notes{};   ///< the same: what was added to a file that lacks it
    double load_seconds = 0.0;          ///< for reading files
    double build_seconds = 0.0;         ///< for making the scene ready
    std::string xmp{};                  ///< what the file says about itself
    std::size_t lights = 0;  ///< of the file and by --env, without what is added where all is dark
    bool is_framed = false;  ///< the camera is none of the file
    std::vector<CameraDesc> cameras{};           ///< those of the scene
    std::vector<std::filesystem::path> files{};  ///< that the scene names
    io::MemoryBudget memory;                     ///< of which the scene has taken its part
};

/// Does bdpt itself make the light from infinity, the default sky or the studio?
[[nodiscard]] bool has_own_environment(const PreparedScene& stage);

/// A camera and the size of its image.
struct Viewpoint {
    CameraDesc camera;  ///< named by its name or index
    Size size;
    bool is_framed = false;  ///< the camera is none of the file
};

/// Loads the file, and fills in what it lacks by the rules that `bdpt render --help` states.
/// What that takes is taken from `arguments.scene.memory`, or from `arguments.memory` if there is
/// none. Throws `Error`.
[[nodiscard]] PreparedScene prepare_scene(const RenderArguments& arguments);

/// Camera `index` of the scene, as `arguments` change its view and its lens. Throws `Error`.
[[nodiscard]] Viewpoint viewpoint(const PreparedScene& stage, std::size_t index,
                                  const RenderArguments& arguments);

/// What the camera that `arguments` choose sees of the scene; it may be framed for another size
/// than before. Throws `Error`.
[[nodiscard]] Viewpoint viewpoint(const PreparedScene& stage, const RenderArguments& arguments);

/// The names of the cameras, or their indices if they have none.
[[nodiscard]] std::vector<std::string> camera_names(const PreparedScene& stage);

}  // namespace bdpt::app
