#pragma once

#include <bdpt/error.h>
#include <bdpt/io/gltf.h>
#include <bdpt/scene.h>

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "options/arguments.h"

namespace bdpt::app {

/// A material that emits.
struct EmissiveMaterial {
    std::string name;
    Rgb emission{0.0f};  ///< [nit]
};

/// What a render would fill in.
struct Defaults {
    bool camera = false;  ///< that frames the scene
    bool sky = false;
    bool lamp = false;   ///< in a closed room
    bool glows = false;  ///< the only light of the file are materials that emit
};

/// Why a render would fail.
struct Problem {
    ErrorCode code = ErrorCode::internal;
    std::string message;
};

/// How much is known of a scene.
enum class Knowledge : std::uint8_t {
    facts,   ///< what the JSON of the file says; it cannot be loaded
    loaded,  ///< all but what only a built scene knows, its counts and bounds
    built,
};

/// What `bdpt info` tells.
struct SceneReport {
    std::string file;
    io::GltfFacts facts;
    std::vector<CameraDesc> cameras;
    std::vector<LightDesc> lights;       ///< environments without their pixels
    std::vector<std::string> materials;  ///< names
    std::vector<EmissiveMaterial> emissive;
    std::vector<Size> texture_sizes;
    std::size_t instances = 0;
    std::vector<std::string> warnings;
    Defaults defaults;
    std::optional<Problem> problem;
    Knowledge knowledge = Knowledge::facts;
    SceneCounts counts;
    std::optional<Bounds> bounds;  ///< none: nothing to see
};

/// All but what only a built scene knows.
[[nodiscard]] SceneReport make_report(const std::string& file, const io::LoadedScene& loaded);

/// For people.
[[nodiscard]] std::string to_text(const SceneReport& report);
/// For programs.
[[nodiscard]] nlohmann::ordered_json to_json(const SceneReport& report);

}  // namespace bdpt::app
