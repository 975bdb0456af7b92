#pragma once

/// @file
/// Names the scene, the camera and the size of a benchmark.
///
/// @code{.cpp}
/// bdpt::io::LoadedScene file = bdpt::io::load_gltf("room.glb");
/// const bdpt::Scene scene(std::move(file.scene));
/// const bdpt::eval::BenchScene room = {.name = "room",
///                                      .file = "room.glb",
///                                      .scene = scene,
///                                      .camera = file.cameras.at(0),
///                                      .width = 320,
///                                      .height = 180};
/// @endcode

#include <bdpt/scene.h>
#include <bdpt/scene_desc.h>

#include <string>

namespace bdpt::eval {

/// A scene to benchmark.
struct BenchScene {
    std::string name;  ///< used in file names: letters, digits, "_", "-" and "."; unique per scene
    std::string file;  ///< path of the scene, for people
    std::string environment{};  ///< source of light from infinity, for people
    const Scene& scene;
    CameraDesc camera;
    int width = 0;  ///< [pixels]
    int height = 0;
};

}  // namespace bdpt::eval
