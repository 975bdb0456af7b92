#pragma once

#include <bdpt/error.h>
#include <bdpt/eval/bench.h>
#include <bdpt/eval/comparison.h>
#include <bdpt/eval/verify.h>
#include <bdpt/io/gltf.h>
#include <bdpt/scene.h>
#include <bdpt/scene_desc.h>

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "options/value_types.h"
#include "terminal/console.h"

namespace bdpt::app {

// `origin`: that of the world, in the coordinates of the file, which positions are told in.

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

/// Returns the results of a scene as a table for people. `seconds` is the CPU time of runs at equal
/// time.
[[nodiscard]] std::string bench_text(const eval::SceneResult& scene, double seconds);

/// Returns the report as tables for people.
[[nodiscard]] std::string compare_text(const eval::ComparisonReport& report,
                                       std::span<const eval::ThresholdResult> thresholds);

/// Returns the report as tables for people, the verdict last.
[[nodiscard]] std::string verify_text(const eval::VerifyReport& report,
                                      const eval::VerifyOptions& options);

}  // namespace bdpt::app
