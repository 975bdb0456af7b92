#pragma once

#include <bdpt/error.h>
#include <bdpt/io/gltf.h>
#include <bdpt/scene.h>
#include <bdpt/scene_desc.h>

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "options/value_types.h"
#include "terminal/console.h"

namespace bdpt::app {

/// Returns `light` without the pixels of an environment.
[[nodiscard]] LightDesc without_pixels(const LightDesc& light);

// `origin`: that of the world, in the coordinates of the file, which positions are told in.

/// Returns a light as a line for people.
[[nodiscard]] std::string light_text(const LightDesc& light, const DVec3& origin);
/// Returns a light as an object: "kind" and its properties by kind.
[[nodiscard]] nlohmann::ordered_json light_json(const LightDesc& light, const DVec3& origin);

/// A material that emits.
struct EmissiveMaterial {
    std::string name;
    Rgb emission{0.0f};  ///< [nit]
};

/// Defaults that a render would fill in.
struct Defaults {
    bool camera = false;  ///< a camera that frames the scene
    bool sky = false;
    bool lamp = false;   ///< a point light in a closed room
    bool glows = false;  ///< emissive materials are the only light of the file
};

/// Reason why a render would fail.
struct Problem {
    ErrorCode code = ErrorCode::internal;
    std::string message;
};

/// Level of knowledge about a scene.
enum class Knowledge : std::uint8_t {
    facts,   ///< facts from the file's JSON; it cannot be loaded
    loaded,  ///< all but the counts and bounds, which need a built scene
    built,
};

/// Contents of the output of `bdpt info`.
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
    std::optional<Bounds> bounds;  ///< none: nothing is visible
    DVec3 origin{0.0};             ///< of the world, which cameras, lights and bounds are in
};

/// Collects all but what only a built scene knows.
[[nodiscard]] SceneReport make_report(const std::string& file, const io::LoadedScene& loaded);

/// Formats the report for people.
[[nodiscard]] std::string info_text(const SceneReport& report);
/// Formats the report for programs.
[[nodiscard]] nlohmann::ordered_json info_json(const SceneReport& report);

}  // namespace bdpt::app
