#pragma once

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
