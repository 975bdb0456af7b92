#pragma once

#include <bdpt/export.h>
#include <bdpt/scene.h>
#include <bdpt/scene_desc.h>

#include <cstdint>
#include <string>

namespace bdpt::eval {

/// What is rendered in a benchmark.
struct BenchScene {
    std::string name;  ///< of files: letters, digits, "_", "-" and "."; each scene has its own
    std::string file;  ///< for people
    std::string environment{};  ///< the same: where light from infinity comes from
    std::uint64_t content = 0;  ///< `content_hash` of what the scene was built from
    const Scene& scene;
    CameraDesc camera;
    int width = 0;  ///< [pixels]
    int height = 0;
};

/// A number that differs, in all likelihood, between scenes that differ in anything but names
/// [FNV-1a, 64 bits]. The same on every machine with this byte order.
[[nodiscard]] BDPT_EXPORT std::uint64_t content_hash(const SceneDesc& scene);
/// The same for cameras.
[[nodiscard]] BDPT_EXPORT std::uint64_t content_hash(const CameraDesc& camera);

}  // namespace bdpt::eval
