#pragma once

#include <bdpt/io/gltf.h>
#include <bdpt/scene.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "options/arguments.h"
#include "options/render_arguments.h"

namespace bdpt::app {

/// A scene with light and a camera: ready to render.
struct PreparedScene {
    Scene scene;
    CameraDesc camera;             ///< named by its name or index, or "auto"
    std::string environment_name;  ///< for people: its file, "scene", "default" or "none"
    Size size;
    std::vector<std::string> warnings;  ///< one line each
    double load_seconds = 0.0;          ///< for reading files
    double build_seconds = 0.0;         ///< for making the scene ready
    std::string xmp{};                  ///< what the file says about itself
    std::size_t lights = 0;  ///< of the file and by --env, without what is added where all is dark
    /// The only lights are surfaces of the file that emit.
    bool only_emitters = false;
};

/// Loads the file, and fills in what it lacks by the rules that `bdpt render --help` states.
/// `look` is shown what the scene will be built from. Throws `Error`.
[[nodiscard]] PreparedScene prepare_scene(const RenderArguments& arguments,
                                          const std::function<void(const SceneDesc&)>& look = {});

}  // namespace bdpt::app
