#pragma once

#include <bdpt/io/gltf.h>
#include <bdpt/scene.h>

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace bdpt::app {

/// What `bdpt info` tells. Made before the scene's data moves into a `Scene`, which adds the last
/// three members.
struct SceneReport {
    std::string file;
    io::GltfFacts facts;
    std::vector<CameraDesc> cameras;
    std::vector<std::string> lights;         ///< one line each
    std::vector<std::string> materials;      ///< names
    std::vector<std::string> emissive;       ///< names of materials that emit
    std::vector<std::string> texture_sizes;  ///< "1024x512"
    std::size_t instances = 0;
    std::vector<std::string> warnings;
    std::vector<std::string> defaults;  ///< what a render would fill in
    SceneCounts counts;
    std::optional<Bounds> bounds;  ///< none: nothing to see
};

[[nodiscard]] SceneReport make_report(const std::string& file, const io::LoadedScene& loaded);

/// For people.
[[nodiscard]] std::string to_text(const SceneReport& report);
/// For programs.
[[nodiscard]] nlohmann::ordered_json to_json(const SceneReport& report);

}  // namespace bdpt::app
