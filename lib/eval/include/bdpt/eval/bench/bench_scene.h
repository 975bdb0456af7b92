#pragma once

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
