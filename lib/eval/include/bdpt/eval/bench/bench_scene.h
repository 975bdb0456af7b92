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

/// A scene of a benchmark.
struct BenchScene {
    std::string name;  ///< of files: letters, digits, "_", "-" and "."; each scene has its own
    std::string file;  ///< for people
    std::string environment{};  ///< the same: where light from infinity comes from
    const Scene& scene;
    CameraDesc camera;
    int width = 0;  ///< [pixels]
    int height = 0;
};

}  // namespace bdpt::eval
